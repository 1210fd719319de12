"""Whether a function that a patch of patches/ changes is fixed in the library that is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from bench.studies.libraries.asked import compiled, version_of
from bench.studies.libraries.judge import FORMS, quiet, said, turn_error
from bench.studies.libraries.turns import DIGITS, Turn, about

if TYPE_CHECKING:
    from bench.studies.libraries.library import Library

FIXED_SHARE = 0.01
"""Largest error of a fixed function, as a share of the angle; in single precision an angle of 3e-4 rad needs 0.004."""


class Reproduction(NamedTuple):
    """A turn that a library's function returned wrongly before the patch; with sign -1, of its quaternion -q."""

    library: str
    function: str
    turn: Turn
    sign: float = 1.0


def turn_by(angle_rad: Any, *axis: int) -> Turn:
    """Return the turn by an angle, in 60 digits, about an axis of any length."""
    return about(axis, DIGITS.cos(angle_rad / 2), DIGITS.sin(angle_rad / 2))


REPRODUCTIONS = {
    "mink": Reproduction("mink", "SO3.log (Python)", about((1, 0, 0), 0, 1)),
    "numpy-quaternion": Reproduction("numpy-quaternion", "as_rotation_vector", turn_by(1.0, 0, 1, 0), -1.0),
    "kdl": Reproduction("kdl", compiled.SMALL_EPS.name, turn_by(DIGITS.pi - 1e-7, 0, 0, 1)),
    "tf2": Reproduction("tf2", "Matrix3x3::getRPY", about((-1, 1, 1), 1, DIGITS.sqrt(3))),  # exactly at a pole
    "robosuite": Reproduction("robosuite", "mat2quat, quat2axisangle", turn_by(3e-4, 1, 2, -3)),
    "transforms3d": Reproduction("transforms3d", "mat2axangle", turn_by(1e-5, -3, 0, 1)),
}


@quiet
def check_patches(library: Library) -> dict[str, dict[str, Any]]:
    """Return for every patch of an installed library its version, whether it is fixed, and the error [rad]."""
    functions, checked = {one.name: one for one in (compiled.SMALL_EPS, *library.functions)}, {}
    for patch, case in REPRODUCTIONS.items():
        if case.library == library.name:
            function = functions[case.function]
            error = turn_error(FORMS[function.form], said(function, case.turn, case.sign), case.turn)
            state = "fixed" if error <= FIXED_SHARE * case.turn.angle else "not fixed"
            checked[patch] = {"version": version_of(library), "state": state, "error_rad": float(f"{error:.3g}")}
    return checked
