"""tf2, of ROS: Quaternion's angle and axis."""

from bench.studies.libraries.compiled import load
from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

TF2 = load("tf2", "-I/usr/include/console_bridge")

LIBRARY = Library(
    "tf2",
    "libtf2-dev",
    (
        Function("Quaternion: getAngle, getAxis", QUATERNION, TF2("angle_axis")),
        Function("Quaternion: getAngleShortestPath, getAxis", QUATERNION, TF2("shortest_path")),
        Function("Matrix3x3::getRotation, getAngle, getAxis", MATRIX, TF2("angle_axis_of_matrix")),
        Function("Matrix3x3::getRPY", MATRIX, TF2("get_rpy"), "z-y-x"),
    ),
    is_debian=True,
)
