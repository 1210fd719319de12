// What each file here is built with: `one` gives the error of one pair, `all_errors` those of n.

#include <Eigen/Dense>
#include <Eigen/Geometry>

void one(const Eigen::Quaterniond &goal, const Eigen::Quaterniond &now, Eigen::Vector3d &e);

extern "C" void all_errors(int n, const double *pairs, double *errors) {
  for (int i = 0; i < n; ++i, pairs += 8, errors += 3) {
    Eigen::Vector3d e;
    one(Eigen::Quaterniond(pairs[0], pairs[1], pairs[2], pairs[3]),
        Eigen::Quaterniond(pairs[4], pairs[5], pairs[6], pairs[7]), e);
    Eigen::Map<Eigen::Vector3d> to(errors);
    to = e;
  }
}
