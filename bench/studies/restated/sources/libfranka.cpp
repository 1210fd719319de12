#include "ours.h"

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  Eigen::Affine3d transform(now);
  Eigen::Quaterniond orientation(transform.rotation()), orientation_d(goal);
  Eigen::Matrix<double, 6, 1> error;
  //@ examples/cartesian_impedance_control.cpp 89-98
  e = -error.tail(3);
}
