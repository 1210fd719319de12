#include <math.h>

#include "ours.h"

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  Eigen::Affine3d T_EE_in_base_frame(now);
  Eigen::Quaterniond desired_quat_EE_in_base_frame(goal), quat_EE_in_base_frame(now);
  Eigen::Vector3d desired_pos_EE_in_base_frame(0, 0, 0), pos_EE_in_base_frame(0, 0, 0);
  //@ deoxys/franka-interface/src/controllers/osc_impedance.cpp 167-179
  //@ deoxys/franka-interface/src/controllers/osc_impedance.cpp 207-208
  e = ori_error;
}
