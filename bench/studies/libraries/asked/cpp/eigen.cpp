// Eigen: what a controller in C++ calls for the error of a rotation given as R (row by row) or as (w, x, y, z).

#include <Eigen/Geometry>

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

static Eigen::Quaterniond quaternion(const double *q) { return {q[0], q[1], q[2], q[3]}; }

static void write(const Eigen::Vector3d &e, double *out) {
    for (int i = 0; i < 3; ++i) out[i] = e[i];
}

static void write(const Eigen::AngleAxisd &found, double *out) { write(found.angle() * found.axis(), out); }

extern "C" {
void angle_axis_of_matrix(const double *R, double *e) {
    const Eigen::Matrix3d T = Eigen::Map<const Matrix>(R);
    write(Eigen::AngleAxisd(T), e);
}

void angle_axis_of_quaternion(const double *q, double *e) { write(Eigen::AngleAxisd(quaternion(q)), e); }

void vector_part_of_matrix(const double *R, double *e) {
    const Eigen::Matrix3d T = Eigen::Map<const Matrix>(R);
    write(2.0 * Eigen::Quaterniond(T).vec(), e);
}

void euler_angles(const double *R, double *e) {
    const Eigen::Matrix3d T = Eigen::Map<const Matrix>(R);
    write(T.eulerAngles(2, 1, 0).reverse(), e);
}
}
