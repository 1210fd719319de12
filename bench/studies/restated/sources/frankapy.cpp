#include "ours.h"

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  Eigen::Affine3d transform(now);
  Eigen::Quaterniond orientation(transform.linear()), orientation_d(goal);
  Eigen::Matrix<double, 6, 1> error;
  //@ franka-interface/src/feedback_controller/cartesian_impedance_feedback_controller.cpp 93-102
  e = -error.tail(3);
}
