"""What `bench audit` says of a library's function, and what to put in the place of a faulty one.

The replacements return theta k of the shorter rotation everywhere, with all its digits; at 180°, either direction.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from bench.audit import audit
from bench.audit.convention import FORMS
from bench.studies.libraries.library import MATRIX, QUATERNION, Function, answer, quiet

if TYPE_CHECKING:
    from bench.audit.report import Report


def left_to_go(q: np.ndarray, q_d: np.ndarray) -> np.ndarray:
    """q_d q*, (w, x, y, z)."""
    w, v, w_d, v_d = q[0], q[1:], q_d[0], q_d[1:]
    return np.array((w_d * w + v_d @ v, *(w * v_d - w_d * v - np.cross(v_d, v))))


@quiet
def report(function: Function) -> Report:
    """Return the audit of a function that is called with the rotation to the goal, R_d R^T, in the base frame."""
    if function.takes == MATRIX:
        return audit(lambda R, R_d: answer(function, R_d @ R.T), "matrix", name=function.name)
    return audit(lambda q, q_d: answer(function, left_to_go(q, q_d)), "wxyz", name=function.name)


def verdict(function: Function) -> dict[str, str]:
    """Convention, faults and replacement of a function, as columns of verdicts.parquet."""
    found, convention = report(function), ""
    if one := found.convention:
        form = FORMS[one.form].title if one.form else "a size of its own"
        convention = f"{form}, {one.frame}, {one.sign}, slope {one.slope:.4g}"
    name, faults = smallest_fix(function) if found.faults else ("", ())
    return {
        "takes": function.takes,
        "convention": convention,
        "faults": ", ".join(found.faults),
        "replacement": name,
        "replacement_faults": ", ".join(faults),
    }


def smallest_fix(function: Function) -> tuple[str, tuple[str, ...]]:
    """Return the smallest change that cures a function, the library's own first, and the faults that remain."""
    if function.fix:
        return function.fix, ()
    if function.takes == QUATERNION:
        other = function._replace(call=lambda q: function.call(-q if q[0] < 0.0 else q))
        if not report(other).faults:
            return "`-q` where w < 0, before it", ()
    replacement = REPLACEMENTS[function.takes]
    return f"`{replacement.__name__}`", report(Function("", function.takes, replacement)).faults


def of_quaternion(quat_wxyz: np.ndarray) -> np.ndarray:
    """theta k of a unit quaternion (w, x, y, z) of either sign: 2 atan2(|v|, w) v/|v|, with w >= 0."""
    w, v = float(quat_wxyz[0]), np.asarray(quat_wxyz[1:], dtype=float)
    if w < 0.0:
        w, v = -w, -v
    length = math.hypot(*v)
    return v * (2.0 * math.atan2(length, w) / length if length > 0.0 else 2.0)


def of_matrix(R: np.ndarray) -> np.ndarray:
    """theta k of a rotation matrix (3 x 3): the longest row of 4 q q^T is a multiple of q (Shepperd 1978)."""
    (a, b, c), (d, e, f), (g, h, i) = np.asarray(R, dtype=float)
    four_q_q = (
        (1.0 + a + e + i, h - f, c - g, d - b),
        (h - f, 1.0 + a - e - i, b + d, c + g),
        (c - g, b + d, 1.0 - a + e - i, f + h),
        (d - b, c + g, f + h, 1.0 - a - e + i),
    )
    row = max(range(4), key=lambda k: four_q_q[k][k])
    return of_quaternion(np.array(four_q_q[row]) / math.hypot(*four_q_q[row]))


REPLACEMENTS = {MATRIX: of_matrix, QUATERNION: of_quaternion}
"""Makes the replacement, by what a function takes."""
