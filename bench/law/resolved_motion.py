"""What resolves a motion of the tool into motions of the joints: an arm as its controller sees it, Jacobian, inverse.

Resolved motion is Whitney's word (1969, of rates), and that of Luh, Walker and Paul (1980, of accelerations).

Shapes: a vector is a tuple of 3 numbers, R a `Rotation`. Base frame, SI units. A buffer is an array A[i, j] or b[i] of
numbers: float64, or counting scalars.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

from bench.law.so3 import Rotation


class Chain(NamedTuple):
    """An arm of n hinges at one tick, as its controller sees it; base frame, SI units.

    axes[i, :] is z_i, the direction of joint i, and anchors[i, :] is p_i, a point on it, from the forward kinematics;
    qdot[i] [rad/s]; p and R are the tool's position [m] and orientation. Joints in order from the base.
    """

    n: int
    axes: Any
    anchors: Any
    qdot: Any
    p: tuple
    R: Rotation


class Jacobian(NamedTuple):
    """Which motion of the tool the joint rates are mapped to: xdot = J qdot, of 6 or 7 rows, the linear ones first.

    takes: "angular-acceleration" if the controller commands omegadot (Murphy 1988, 2.2), "coordinates" if it commands
    Eddot (3.7).

    An "angular-acceleration" Jacobian gives kernels_in(None) -> (fill, express):
        fill(J, chain)          writes rows 0 to 5
        express(chain, a)       the six numbers of a base-frame acceleration, in the frame of J
    A "coordinates" Jacobian gives kernels_in(representation) -> (fill, drift):
        fill(J, chain, at)                   writes its rows; `at` is the representation's chart of chain.R
        drift(chain, at, Edot, omega, bias)  Jdot qdot as a tuple of its rows; `bias` is that of the geometric one
    needs_derivatives: whether the representation must give `differentiate` and `differentiate_twice`.
    """

    name: str
    title: str
    source: str
    formula: str
    takes: str
    kernels_in: Callable
    needs_derivatives: bool = False


class Inverse(NamedTuple):
    """How a commanded acceleration a of the tool becomes one of the joints, or joint torques.

    resolve(J, a, D, x, rows, n, scratch): from J (rows x n), a (rows) and the inertia matrix D (n x n) writes x (n).
    J, a and D are left as they are.
    gives: "acceleration" if J x = a, up to the inverse's own error; "torque" if x is the torque for it; "joint-torque"
    of a baseline on the joints, if it is what gravity leaves to be added.
    refuses(rows, n) -> why it cannot be used with a Jacobian of that shape; empty if it can, as any can by default.
    """

    name: str
    title: str
    source: str
    formula: str
    resolve: Callable
    gives: str
    refuses: Callable[[int, int], str] = lambda rows, n: ""


class Scratch(NamedTuple):
    """Buffers an inverse may overwrite: matrices A, B, V of 7 x 7, vectors s, t of 7."""

    A: Any
    B: Any
    V: Any
    s: Any
    t: Any
