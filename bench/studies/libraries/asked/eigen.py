"""Eigen, which most controllers in C++ are written on: AngleAxis and Quaternion."""

from bench.studies.libraries.compiled import load
from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

EIGEN = load("eigen", "-I/usr/include/eigen3")

LIBRARY = Library(
    "eigen",
    "libeigen3-dev",
    (
        Function("AngleAxisd, of a matrix", MATRIX, EIGEN("angle_axis_of_matrix")),
        Function("AngleAxisd, of a quaternion", QUATERNION, EIGEN("angle_axis_of_quaternion")),
        Function(
            "2 Quaterniond, vector part", MATRIX, EIGEN("vector_part_of_matrix"), "sine-of-half", True, "`AngleAxisd`"
        ),
        Function("eulerAngles(2, 1, 0)", MATRIX, EIGEN("euler_angles"), "z-y-x"),
    ),
    is_debian=True,
)
