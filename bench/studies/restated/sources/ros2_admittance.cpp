#include "ours.h"

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  struct {
    Eigen::Isometry3d ref_trans_base_ft, admittance_position;
  } admittance_state{Eigen::Isometry3d(goal), Eigen::Isometry3d::Identity()};
  const Eigen::Isometry3d desired_trans_base_ft(now);
  Eigen::Matrix<double, 6, 1> X = Eigen::Matrix<double, 6, 1>::Zero();
  //@ admittance_controller/include/admittance_controller/admittance_rule_impl.hpp 255-264
  e = -X.tail<3>();
}
