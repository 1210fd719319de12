#include "ours.h"

//@ src/cartesian_impedance_controller.cpp 16-28

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  e = -calculateOrientationError(goal, now);
}
