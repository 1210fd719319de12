// Orocos KDL: its rotation vector, and the difference of two frames that its solvers and controllers take.

#include <kdl/frames.hpp>

static KDL::Rotation rotation(const double *R) {
    return {R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]};
}

static void write(const KDL::Vector &v, double *e) {
    for (int i = 0; i < 3; ++i) e[i] = v(i);
}

static void write_rot_angle(const double *R, double eps, double *e) {
    KDL::Vector axis;
    const double angle = rotation(R).GetRotAngle(axis, eps);
    write(angle * axis, e);
}

extern "C" {
void get_rot(const double *R, double *e) { write(rotation(R).GetRot(), e); }

void get_rot_angle(const double *R, double *e) { write_rot_angle(R, KDL::epsilon, e); }

void get_rot_angle_with_small_eps(const double *R, double *e) { write_rot_angle(R, 1e-9, e); }

void diff(const double *R, double *e) { write(KDL::diff(KDL::Rotation::Identity(), rotation(R)), e); }

void get_quaternion(const double *R, double *e) {
    double x, y, z, w;
    rotation(R).GetQuaternion(x, y, z, w);
    write(KDL::Vector(2.0 * x, 2.0 * y, 2.0 * z), e);
}

void of_quaternion(const double *q, double *e) {
    write(KDL::Rotation::Quaternion(q[1], q[2], q[3], q[0]).GetRot(), e);
}

void get_rpy(const double *R, double *e) { rotation(R).GetRPY(e[0], e[1], e[2]); }
}
