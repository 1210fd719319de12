"""Motion of the tool of a chain of hinges: its velocity J qdot and acceleration Jdot qdot, from joint to joint.

With w_i = z_i qdot_i the links turn at omega_i = omega_{i-1} + w_i. The axis z_i and the anchor p_i are fixed in link
i - 1, the first ones in the base, so with r_i = p_i - p_{i-1}

    zdot_i = omega_{i-1} x z_i           omegadot_i = omegadot_{i-1} + z_i qddot_i + omega_{i-1} x w_i
    pdot_i = pdot_{i-1} + omega_{i-1} x r_i
    pddot_i = pddot_{i-1} + omegadot_{i-1} x r_i + omega_{i-1} x (omega_{i-1} x r_i)

and the tool is the last of these points. What is left of its acceleration at qddot = 0 is Jdot qdot: the forward half
of Newton and Euler's recursion (Luh, Walker, Paul 1980), with neither J nor Jdot formed.

A chain here has two hinges at least.
"""

from typing import Any, NamedTuple

from bench.law.scalar import kernel
from bench.law.so3 import Rotation, cross


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


class Scratch(NamedTuple):
    """Buffers an inverse may overwrite: matrices A, B, V of 7 x 7, vectors s, t of 7."""

    A: Any
    B: Any
    V: Any
    s: Any
    t: Any


@kernel
def plus(v, w):
    """v + w."""
    return (v[0] + w[0], v[1] + w[1], v[2] + w[2])


@kernel
def turn(chain, i):
    """w_i = z_i qdot_i, what joint i adds to the angular velocity."""
    axes, rate = chain.axes, chain.qdot[i]
    return (axes[i, 0] * rate, axes[i, 1] * rate, axes[i, 2] * rate)


@kernel
def step(chain, i):
    """r_i = p_i - p_{i-1}, from the anchor before to that of joint i."""
    anchors, j = chain.anchors, i - 1
    return (anchors[i, 0] - anchors[j, 0], anchors[i, 1] - anchors[j, 1], anchors[i, 2] - anchors[j, 2])


@kernel
def last_step(chain):
    """From the last joint's anchor to the tool."""
    anchors, p, j = chain.anchors, chain.p, chain.n - 1
    return (p[0] - anchors[j, 0], p[1] - anchors[j, 1], p[2] - anchors[j, 2])


@kernel
def twist(chain):
    """pdot [m/s] and omega [rad/s] of the tool, base frame."""
    omega = turn(chain, 0)
    pdot = cross(omega, step(chain, 1))
    omega = plus(omega, turn(chain, 1))
    for i in range(2, chain.n):
        pdot = plus(pdot, cross(omega, step(chain, i)))
        omega = plus(omega, turn(chain, i))
    return plus(pdot, cross(omega, last_step(chain))), omega


@kernel
def bias_acceleration(chain):
    """Jdot qdot of the geometric Jacobian: three numbers of pddot [m/s^2], three of omegadot [rad/s^2], base frame."""
    omega = turn(chain, 0)
    pddot = cross(omega, cross(omega, step(chain, 1)))
    added = turn(chain, 1)
    omegadot = cross(omega, added)
    omega = plus(omega, added)
    for i in range(2, chain.n):
        r = step(chain, i)
        pddot = plus(pddot, plus(cross(omegadot, r), cross(omega, cross(omega, r))))
        added = turn(chain, i)
        omegadot = plus(omegadot, cross(omega, added))
        omega = plus(omega, added)
    r = last_step(chain)
    pddot = plus(pddot, plus(cross(omegadot, r), cross(omega, cross(omega, r))))
    return (pddot[0], pddot[1], pddot[2], omegadot[0], omegadot[1], omegadot[2])
