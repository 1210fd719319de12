"""What an exported spring with a stiffness matrix is asked: its moment on the body."""

from collections.abc import Callable

from bench.export.entries import FORMS, Entry, Form, Parameter, named_entry
from bench.law import kernel, quaternion_direction, relative, rotate, sqrt

STIFFNESS = Parameter("stiffness", "tuple", 9)
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
        quat_wxyz, t = quaternion_direction(relative(read(R_d), read(R)))
        shorter = 0.5 / sqrt(t)
        q = (shorter * quat_wxyz[0], shorter * quat_wxyz[1], shorter * quat_wxyz[2], shorter * quat_wxyz[3])
        K = (
            (stiffness[0], stiffness[1], stiffness[2]),
            (stiffness[3], stiffness[4], stiffness[5]),
            (stiffness[6], stiffness[7], stiffness[8]),
        )
        return law(q, K)

    @kernel
    def moment(R, R_d, stiffness):
        return rotate(read(R), moment_body(R, R_d, stiffness))

    return {"moment": moment, "moment_body": moment_body}
