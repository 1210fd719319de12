"""The regulator of Luh, Walker and Paul, on the columns of R (Murphy 1988, 2.12-2.13).

Limitations: every 180° rotation is a point of rest, for there sin(theta) = 0; settling time grows without bound towards
it.
"""

from bench.law import PUBLISHED, SINE, Display, Law, Look, cross, kernel


@kernel
def law(R, omega, goal, gains):
    """u = Kp e - Kv omega with e = (n x n_d + o x o_d + a x a_d) / 2 = sin(theta) k.

    Args: R and goal.R rotations, omega [rad/s], all in the base frame.
    Returns: angular acceleration [rad/s^2], base frame.
    Source: Luh, Walker, Paul 1980; Murphy 1988, (2.12)-(2.13).
    """
    n = cross(R.n, goal.R.n)
    o = cross(R.o, goal.R.o)
    a = cross(R.a, goal.R.a)
    half = 0.5 * gains.kp
    return (
        half * (n[0] + o[0] + a[0]) - gains.kv * omega[0],
        half * (n[1] + o[1] + a[1]) - gains.kv * omega[1],
        half * (n[2] + o[2] + a[2]) - gains.kv * omega[2],
    )


REGULATOR = Law(
    name="rotation-matrix",
    title="Rotation matrix (Luh, Walker, Paul)",
    source="Luh, Walker, Paul 1980; also Murphy 1988, (2.12)-(2.13)",
    attribution=PUBLISHED,
    formula=r"u = \tfrac{1}{2} K_p\,(n \times n_d + o \times o_d + a \times a_d) - K_v\,\omega",
    law=law,
    property="almost global",
    display=Display("rotation matrix", Look("blue", "o", "solid"), "The paper's three", SINE),
)
