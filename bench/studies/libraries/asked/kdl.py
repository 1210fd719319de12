"""Orocos KDL, of ROS: Rotation.GetRot, and the diff of its solvers."""

from bench.studies.libraries.compiled import load
from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

KDL = load("kdl", "-I/usr/include/eigen3", "-lorocos-kdl")

LIBRARY = Library(
    "kdl",
    "liborocos-kdl-dev",
    (
        Function("Rotation::GetRot", MATRIX, KDL("get_rot")),
        Function("Rotation::GetRotAngle", MATRIX, KDL("get_rot_angle")),
        Function("diff", MATRIX, KDL("diff")),
        Function("Rotation::Quaternion, GetRot", QUATERNION, KDL("of_quaternion")),
        Function("2 GetQuaternion, vector part", MATRIX, KDL("get_quaternion"), "sine-of-half"),
        Function("Rotation::GetRPY", MATRIX, KDL("get_rpy"), "z-y-x"),
    ),
    is_debian=True,
)
