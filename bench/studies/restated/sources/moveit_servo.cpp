#include "ours.h"

struct {
  struct {
    double linear = 0.4, rotational = 0.8;
  } scale;
  double publish_period = 0.01;  // config/servo_parameters.yaml
} servo_params;

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  struct {
    Eigen::Isometry3d pose;
  } command{Eigen::Isometry3d(goal)};
  const Eigen::Isometry3d ee_pose(now);
  Eigen::Vector<double, 6> cartesian_position_delta;
  //@ moveit_ros/moveit_servo/src/utils/command.cpp 251-278
  e = cartesian_position_delta.tail<3>();
}
