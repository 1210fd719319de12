#include "ours.h"

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  Eigen::Affine3d transform(now);
  Eigen::Quaterniond orientation(transform.rotation()), orientation_d_(goal);
  Eigen::Matrix<double, 6, 1> error;
  //@ franka_example_controllers/src/cartesian_impedance_example_controller.cpp 153-161
  e = -error.tail(3);
}
