"""tf2, of ROS 1: angle times axis of its quaternion, as users write it, and the angles of Matrix3x3."""

from bench.studies.libraries.compiled import load
from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

TF2 = load("tf2", "-I/usr/include/console_bridge")
NEGATE = "`-q` where `q.w() < 0`, before it"


def idiom(name, takes, word) -> Function:
    """Return an angle of tf2's times its axis, which no function of tf2 gives as one vector."""
    return Function(name, takes, TF2(word), is_idiom=True, fix=NEGATE)


LIBRARY = Library(
    "tf2",
    "libtf2-dev",
    (
        idiom("Quaternion: getAngle * getAxis", QUATERNION, "angle_axis"),
        idiom("Quaternion: getAngleShortestPath * getAxis", QUATERNION, "shortest_path"),
        idiom("Matrix3x3::getRotation: getAngle * getAxis", MATRIX, "angle_axis_of_matrix"),
        Function("Matrix3x3::getRPY", MATRIX, TF2("get_rpy"), "z-y-x", thread="ros/geometry2#504"),
    ),
    is_debian=True,
    note="Debian's package, which is that of ROS 1",
)
