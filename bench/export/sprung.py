"""What an exported spring is asked: its moment on the body; of one of a pose, its force and moment on the hand."""

from collections.abc import Callable

from bench.export.entries import FORMS, Entry, Form, Parameter, named_entry
from bench.law import kernel, minus, quaternion_direction, relative, rotate, rotate_back, sqrt

STIFFNESS, TURNING = Parameter("stiffness", "tuple", 9), Parameter("turning_stiffness", "number")
PLACES = (Parameter("p", "tuple", 3), Parameter("p_d", "tuple", 3))
FORCE = "force on the hand [N] of the stiffness K [N/m], symmetric, row-major; p, p_d: its place, the goal's [m]"
TURN = "moment on the hand about its origin [N m]; turning_stiffness [N m/rad]"
MOMENT = (
    "moment on the body [N m] of the stiffness K at the goal [N m/rad], symmetric, row-major, in the axes of the tool"
)


def of_spring(moment: Callable) -> list[Entry]:
    """Of a spring, as it is in the tool's axes: its moment, in both frames and every form."""
    found = []
    for form in FORMS:
        made = _springing(moment, form)
        for name in made:
            found.append(named_entry(name, form, made, (form.R, form.R_d, STIFFNESS), MOMENT))
    return found


def _springing(law: Callable, form: Form) -> dict[str, Callable]:
    read = form.read

    @kernel
    def moment_body(R, R_d, stiffness):
        return law(turn_left(read(R), read(R_d)), by_rows(stiffness))

    @kernel
    def moment(R, R_d, stiffness):
        return rotate(read(R), moment_body(R, R_d, stiffness))

    return {"moment": moment, "moment_body": moment_body}


@kernel
def turn_left(R, R_d):
    """The unit quaternion (w, x, y, z) of R_d^T R, w >= 0."""
    quat_wxyz, t = quaternion_direction(relative(R_d, R))
    shorter = 0.5 / sqrt(t)
    return (shorter * quat_wxyz[0], shorter * quat_wxyz[1], shorter * quat_wxyz[2], shorter * quat_wxyz[3])


@kernel
def by_rows(k):
    """A matrix of nine numbers."""
    return ((k[0], k[1], k[2]), (k[3], k[4], k[5]), (k[6], k[7], k[8]))


def of_pose_spring(wrench: Callable) -> list[Entry]:
    """Of a spring of position and orientation: force and moment in the hand's axes, in every form."""
    found = []
    for form in FORMS:
        made = _posed(wrench, form)
        for name, doc in (("force_body", FORCE), ("moment_body", TURN)):
            given = (form.R, PLACES[0], form.R_d, PLACES[1], STIFFNESS, TURNING)
            found.append(named_entry(name, form, made, given, doc))
    return found


def _posed(law: Callable, form: Form) -> dict[str, Callable]:
    read = form.read

    @kernel
    def both(R, p, R_d, p_d, stiffness, turning_stiffness):
        goal = read(R_d)
        left = rotate_back(goal, minus(p, p_d))
        return law(turn_left(read(R), goal), left, by_rows(stiffness), turning_stiffness)

    @kernel
    def force_body(R, p, R_d, p_d, stiffness, turning_stiffness):
        force, _moment = both(R, p, R_d, p_d, stiffness, turning_stiffness)
        return force

    @kernel
    def moment_body(R, p, R_d, p_d, stiffness, turning_stiffness):
        _force, moment = both(R, p, R_d, p_d, stiffness, turning_stiffness)
        return moment

    return {"force_body": force_body, "moment_body": moment_body}
