// ROS tf2: angle and axis of its quaternion, by both of its angles, and of a matrix.

#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>

static tf2::Quaternion quaternion(const double *q) { return {q[1], q[2], q[3], q[0]}; }

static tf2::Matrix3x3 matrix(const double *R) {
    return {R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]};
}

static void write(const tf2::Vector3 &v, double *e) {
    for (int i = 0; i < 3; ++i) e[i] = v.m_floats[i];
}

static tf2::Quaternion of_matrix(const double *R) {
    tf2::Quaternion q;
    matrix(R).getRotation(q);
    return q;
}

extern "C" {
void angle_axis(const double *q, double *e) {
    const tf2::Quaternion T = quaternion(q);
    write(T.getAngle() * T.getAxis(), e);
}

void shortest_path(const double *q, double *e) {
    const tf2::Quaternion T = quaternion(q);
    write(T.getAngleShortestPath() * T.getAxis(), e);
}

void angle_axis_of_matrix(const double *R, double *e) {
    const tf2::Quaternion T = of_matrix(R);
    write(T.getAngle() * T.getAxis(), e);
}

void get_rpy(const double *R, double *e) { matrix(R).getRPY(e[0], e[1], e[2]); }
}
