"""A rotational spring with a stiffness matrix: a moment as a function of the turn that is left, and its potential."""

from collections.abc import Callable
from typing import NamedTuple

from bench.law.scalar import kernel


class Spring(NamedTuple):
    """moment(q, K) -> three numbers [N m]; potential(q, K) -> [J], None if there is none for every K.

    q: the unit quaternion (w, x, y, z), w >= 0, of X = R_d^T R, the turn from the goal to the body in the goal's axes.
    K: the stiffness at the goal, symmetric, by rows [N m/rad]. frames: in whose axes the three numbers may be taken,
    "tool" or "goal"; base axes are the goal's, turned by a constant. stiffness: of what K is felt at the goal.
    formula: of the moment, in TeX.
    """

    name: str
    title: str
    source: str
    formula: str
    moment: Callable
    potential: Callable | None = None
    frames: tuple[str, ...] = ("tool", "goal")
    stiffness: float = 1.0


@kernel
def times(K, v):
    """K v of a matrix by rows."""
    return (
        K[0][0] * v[0] + K[0][1] * v[1] + K[0][2] * v[2],
        K[1][0] * v[0] + K[1][1] * v[1] + K[1][2] * v[2],
        K[2][0] * v[0] + K[2][1] * v[1] + K[2][2] * v[2],
    )
