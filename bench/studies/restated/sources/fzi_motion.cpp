#include <algorithm>
#include <frames.hpp>

#include "ours.h"

namespace ctrl {
typedef Eigen::Matrix<double, 6, 1> Vector6D;
}

KDL::Frame frame(const Eigen::Quaterniond &q) { return KDL::Frame(KDL::Rotation::Quaternion(q.x(), q.y(), q.z(), q.w())); }

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e) {
  KDL::Frame m_target_frame = frame(goal), m_current_frame = frame(now);
  //@ cartesian_motion_controller/src/cartesian_motion_controller.cpp 136-168
  e = error.tail(3);
}
