"""Whether a function that a patch of patches/ changes is fixed in the library that is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from bench.studies.libraries.asked import compiled, version_of
from bench.studies.libraries.judge import FORMS, quiet, said, turn_error
from bench.studies.libraries.turns import of_quaternion

if TYPE_CHECKING:
    from bench.studies.libraries.library import Library

FIXED_SHARE = 0.01
"""Largest error of a fixed function, as a share of the angle; in single precision an angle of 3e-4 rad needs 0.004."""


class Reproduction(NamedTuple):
    """A quaternion of any length whose rotation a library's function returned wrongly; with sign -1, given as -q."""

    library: str
    function: str
    quat_wxyz: tuple[int, int, int, int]
    sign: float = 1.0


REPRODUCTIONS = {
    "mink": Reproduction("mink", "SO3.log (Python)", (0, 1, 0, 0)),
    "numpy-quaternion": Reproduction("numpy-quaternion", "as_rotation_vector", (2, 0, 1, 0), -1.0),
    "kdl": Reproduction("kdl", compiled.SMALL_EPS.name, (1, 0, 0, 20_000_000)),
    "tf2": Reproduction("tf2", "Matrix3x3::getRPY", (1, -1, 1, 1)),  # exactly at a pole
    "robosuite": Reproduction("robosuite", "mat2quat, quat2axisangle", (25_000, 1, 2, -3)),
    "transforms3d": Reproduction("transforms3d", "mat2axangle", (640_000, -3, 0, 1)),
}


@quiet
def check_patches(library: Library) -> dict[str, dict[str, Any]]:
    """Return for every patch of an installed library its version, whether it is fixed, and the error [rad]."""
    functions, checked = {one.name: one for one in (compiled.SMALL_EPS, *library.functions)}, {}
    for patch, case in REPRODUCTIONS.items():
        if case.library == library.name:
            function, turn = functions[case.function], of_quaternion(*case.quat_wxyz)
            error = turn_error(FORMS[function.form], said(function, turn, case.sign), turn)
            state = "fixed" if error <= FIXED_SHARE * turn.angle else "not fixed"
            checked[patch] = {"version": version_of(library), "state": state, "error_rad": float(f"{error:.3g}")}
    return checked
