"""Orocos KDL, of ROS: Rotation.GetRot, and the diff of its solvers."""

from bench.studies.libraries.compiled import load
from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

KDL = load("kdl", "-I/usr/include/eigen3", "-lorocos-kdl")
THREAD = "orocos/orocos_kinematics_dynamics#352"

LIBRARY = Library(
    "kdl",
    "liborocos-kdl-dev",
    (
        Function("Rotation::GetRot", MATRIX, KDL("get_rot"), thread=THREAD),
        Function("Rotation::GetRotAngle", MATRIX, KDL("get_rot_angle"), thread=THREAD),
        Function("diff", MATRIX, KDL("diff"), thread=THREAD),
        Function("Rotation::Quaternion, GetRot", QUATERNION, KDL("of_quaternion"), thread=THREAD),
        Function(
            "2 GetQuaternion, vector part", MATRIX, KDL("get_quaternion"), "sine-of-half", True, "`-q` where w < 0"
        ),
        Function("Rotation::GetRPY", MATRIX, KDL("get_rpy"), "z-y-x"),
    ),
    is_debian=True,
)
