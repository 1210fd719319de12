#include "ours.h"

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  Eigen::Affine3d transform(now);
  Eigen::Quaterniond orientation(transform.linear()), orientation_d_(goal);
  Eigen::Matrix<double, 6, 1> error_;
  Eigen::Vector3d rotational_clip_max_ = Eigen::Vector3d::Constant(0.05);  // cfg/compliance_param.cfg
  Eigen::Vector3d rotational_clip_min_ = -rotational_clip_max_;
  //@ src/cartesian_impedance_controller.cpp 159-171
  e = -error_.tail(3);
}
