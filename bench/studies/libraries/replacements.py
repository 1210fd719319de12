"""What to put in the place of a library's faulty error: one function for R, one for a quaternion, a few lines each.

Both return the rotation vector theta k of the shorter rotation, everywhere, with all its digits; at 180° either of the
two directions. They are checked as the libraries are (`verdict.py`).
"""

import math

import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION


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
"""By what a function takes."""
