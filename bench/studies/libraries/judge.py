"""Ask one function for every turn of one set, and compare what it says with the axis and angle that are known.

At exactly 180° either direction along the axis is right. A function that takes quaternions is called with both that
stand for a rotation: (w, x, y, z) with w >= 0 is judged, and its negative compared with that.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bench.audit.convention import FORMS as SIZED
from bench.audit.examined import COUNT_RAD as COUNT_RAD
from bench.findings.libraries import WRONG_AXIS_RAD
from bench.law.contenders.representations.zyx_euler import to_matrix
from bench.studies.libraries.library import QUATERNION, Function, answer, quiet

if TYPE_CHECKING:
    from bench.studies.libraries.turns import Turn, TurnSet

ZERO_SHARE = 1e-6
"""An answer smaller than this times the angle counts as zero."""


class Form(NamedTuple):
    """A form by its closed form: size(theta), along k; or for angles, matrix(e), the turn that they stand for.

    angles(length) -> the angles in [0, 2 pi) that an answer of this length stands for.
    """

    title: str
    size: Callable | None = None
    angles: Callable | None = None
    matrix: Callable | None = None


ANGLES_OF = {
    "rotation-vector": lambda length: (length,),
    "sine-of-half": lambda length: (2.0 * math.asin(min(1.0, 0.5 * length)),),
    "sine": lambda length: (math.asin(min(1.0, length)), math.pi - math.asin(min(1.0, length))),
    "mrp": lambda length: (4.0 * math.atan(0.25 * length),),
}
FORMS = {name: Form(*SIZED[name], angles) for name, angles in ANGLES_OF.items()} | {
    "z-y-x": Form("Z-Y-X angles", matrix=lambda e: np.transpose(to_matrix(e[::-1])))
}
"""Z-Y-X angles stand for R_z(e_z) R_y(e_y) R_x(e_x) (Murphy 1988, 2.4)."""


@quiet
def judge(function: Function, turns: TurnSet, tolerance: float = COUNT_RAD) -> dict[str, Any]:
    """One row: the counts and the worst of a set.

    Returns: how many turns, how many of them failed in each of the ways of KINDS, of how many the negative quaternion
    is answered otherwise (`other_sheet`), the largest error, that of its own form and that of the turn it stands for,
    the largest and the smallest answer. An answer whose turn is right to the tolerance [rad] is usable.
    """
    is_half_turn = turns.distance_rad == 0.0
    kinds, numbers = zip(*(ask(function, one, is_half_turn, tolerance) for one in turns.turns), strict=True)
    columns = "error_rad", "form_error_rad", "turn_error_rad", "largest_rad"
    return {
        "turns": len(kinds),
        **{kind.replace("-", "_"): kinds.count(kind) for kind in KINDS},
        "other_sheet": sum(is_other_sheet(function, one, is_half_turn, tolerance) for one in turns.turns),
        **dict(zip(columns, np.fmax.reduce(numbers), strict=True)),
        "smallest_rad": np.fmin.reduce(numbers)[-1],
    }


KINDS = ("raised", "not-finite", "nought", "long-way", "astray")
"""How an answer can fail to point along the axis of the shorter rotation; else it is `usable`."""


def ask(function: Function, turn: Turn, is_half_turn: bool, tolerance: float) -> tuple[str, tuple[float, ...]]:
    """Return of one turn `usable` or a word of KINDS; the three errors and the length of the answer [rad], or NaN."""
    try:
        e = said(function, turn)
    except Exception:  # whatever a library raises is its answer
        return "raised", (math.nan,) * 4
    if not np.isfinite(e).all():
        return "not-finite", (math.nan,) * 4
    form, size = FORMS[function.form], float(np.linalg.norm(e))
    axis = -turn.axis if is_half_turn and e @ turn.axis < 0.0 else turn.axis
    apart = math.atan2(float(np.linalg.norm(np.cross(axis, e))), float(axis @ e))
    off = turn_error(form, e, turn)
    if off <= tolerance:
        kind = "usable"
    elif size <= ZERO_SHARE * turn.angle:
        kind = "nought"
    elif apart > math.pi - WRONG_AXIS_RAD:
        kind = "long-way"
    elif apart > WRONG_AXIS_RAD:
        kind = "astray"
    else:
        kind = "usable"
    return kind, (gap(e, turn.angle * axis), form_error(form, e, turn, axis), off, size)


def said(function: Function, turn: Turn, sign: float = 1.0) -> np.ndarray:
    """Return the three numbers of a turn, or of its other quaternion."""
    return answer(function, sign * turn.quat_wxyz if function.takes == QUATERNION else turn.R.copy())


def form_error(form: Any, e: np.ndarray, turn: Turn, axis: np.ndarray) -> float:
    """How far e is from what it means to be: in rad along the axis, or of the turn that its angles stand for."""
    if form.size is not None:
        return gap(e, form.size(turn.angle) * axis)
    # |R - R'| = 2 sqrt(2) sin(angle/2) in Frobenius' norm
    return 2.0 * math.asin(min(1.0, float(np.linalg.norm(form.matrix(e) - turn.R)) / math.sqrt(8.0)))


def turn_error(form: Any, e: np.ndarray, turn: Turn) -> float:
    """Return the angle from the turn that e stands for to the one asked, or how much longer e is than the short way.

    Next to 180° the axis k and -k stand for almost one turn, so that this is small where a change of sign does nothing.
    """
    if form.matrix is not None:
        return form_error(form, e, turn, turn.axis)
    length = float(np.linalg.norm(e))
    if length == 0.0:
        return turn.angle
    return min(max(_apart(a, e / length, turn), 2.0 * (a - math.pi)) for a in form.angles(length))


def _apart(angle: float, axis: np.ndarray, turn: Turn) -> float:
    q = np.array((math.cos(0.5 * angle), *(math.sin(0.5 * angle) * axis)))
    return 4.0 * math.asin(min(1.0, 0.5 * min(gap(q, turn.quat_wxyz), gap(q, -turn.quat_wxyz))))


def is_other_sheet(function: Function, turn: Turn, is_half_turn: bool, tolerance: float) -> bool:
    """Whether -q, the same turn, has a wrong answer that differs by more than a thousandth of the angle."""
    if function.takes != QUATERNION:
        return False
    try:
        e, other = said(function, turn), said(function, turn, -1.0)
    except Exception:  # counted as raised already
        return False
    if turn_error(FORMS[function.form], other, turn) <= tolerance:
        return False
    if is_half_turn and e @ other < 0.0:
        other = -other
    return not gap(e, other) <= 1e-3 * turn.angle


def gap(one: np.ndarray, other: np.ndarray) -> float:
    """|one - other|."""
    return float(np.linalg.norm(one - other))
