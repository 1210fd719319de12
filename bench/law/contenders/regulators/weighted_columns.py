"""The rotation-matrix regulator with a weight of its own for each column: only four points of rest are left.

With distinct weights the spring is zero only at the goal and at 180° rotations about n_d, o_d and a_d; those three
are saddles. The price is a stiffness that depends on the axis: about column i half of the sum of the other two weights.

Limitations: at those three 180° rotations, exactly.
"""

from bench.law import PUBLISHED, Display, Law, Look, cross, kernel

WEIGHTS = (0.8, 1.0, 1.2)
"""Distinct, and their sum 3, so that the stiffness is kp on the average: 1.1, 1.0 and 0.9 of it."""


@kernel
def pull_columns(R, R_d, k_1, k_2, k_3):
    """k_1 n x n_d + k_2 o x o_d + k_3 a x a_d, base frame."""
    n, o, a = cross(R.n, R_d.n), cross(R.o, R_d.o), cross(R.a, R_d.a)
    return (
        k_1 * n[0] + k_2 * o[0] + k_3 * a[0],
        k_1 * n[1] + k_2 * o[1] + k_3 * a[1],
        k_1 * n[2] + k_2 * o[2] + k_3 * a[2],
    )


@kernel
def law(R, omega, goal, gains):
    """u = Kp/2 (k_1 n x n_d + k_2 o x o_d + k_3 a x a_d) - Kv omega, k = WEIGHTS."""
    k_1, k_2, k_3 = 0.5 * gains.kp * WEIGHTS[0], 0.5 * gains.kp * WEIGHTS[1], 0.5 * gains.kp * WEIGHTS[2]
    e = pull_columns(R, goal.R, k_1, k_2, k_3)
    return (e[0] - gains.kv * omega[0], e[1] - gains.kv * omega[1], e[2] - gains.kv * omega[2])


REGULATOR = Law(
    name="weighted-columns",
    title="Weighted columns",
    source=(
        "Chaturvedi, Sanyal, McClamroch 2011; the weights 0.8, 1 and 1.2 are ours; also "
        "Chillingworth, Marsden, Wan 1982"
    ),
    attribution=PUBLISHED,
    formula=r"u = \tfrac{1}{2} K_p\,(k_1\, n \times n_d + k_2\, o \times o_d + k_3\, a \times a_d) - K_v\,\omega",
    law=law,
    property="almost global",
    stiffness=(1.1, 1.0, 0.9),
    is_beyond_the_paper=True,
    display=Display("weighted columns", Look("sky", "p", "dashed"), "On the matrix"),
)
