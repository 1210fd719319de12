#include <pinocchio/spatial/explog.hpp>
#include <pinocchio/spatial/se3.hpp>

#include "ours.h"

struct {
  bool use_local_jacobian = false, limit_error = true;  // src/cartesian_controller.yaml
  struct {
    struct {
      double x = 0.1, y = 0.1, z = 0.1, rx = 0.5, ry = 0.5, rz = 0.5;
    } error_clip;
  } task;
} params_;

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  pinocchio::SE3 end_effector_pose(now.toRotationMatrix(), Eigen::Vector3d::Zero());
  Eigen::Quaterniond desired_orientation_(goal);
  Eigen::Vector3d desired_position_(0, 0, 0);
  Eigen::Matrix<double, 6, 1> error, max_delta_;
  //@ src/cartesian_controller.cpp 125-140
  e = error.tail(3);
}
