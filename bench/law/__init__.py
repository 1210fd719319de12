"""What a law is: the dialect it is written in, rotations, small linear algebra, and the records it is made of.

Whoever writes a law, coordinates, a Jacobian, an inverse, an impedance or a spring imports from
here alone:

    from bench.law import Law, cross, dot, kernel, sqrt

What a law may call, with theta k the turn from R to R_d; all vectors in the base frame:

    sqrt(x), sin(x), cos(x), acos(x), atan2(y, x), copysign(magnitude, sign)
    dot(p, q), cross(p, q), minus(p, q)          p . q, p x q, p - q
    rotate(R, v), rotate_back(R, v)              R v, R^T v
    relative(R_d, R), turn_matrix(R, R_d)        R_d^T R, R_d R^T
    trace(R, R_d), half_cosine_squared(R, R_d)   1 + 2 cos(theta), cos^2(theta/2)
    double_sine(R, R_d)                          2 sin(theta) k = n x n_d + o x o_d + a x a_d
    turn_quaternion(R, R_d) -> (w, v, t)         (w, v) = 2 sqrt(t) (cos(theta/2), sin(theta/2) k)
                                                 with w >= 0 and t >= 1
    turn_on_kept_side(R, R_d, memory, DELTA)     (w, v, sqrt(t)) on the side that the law remembers
    rotation_vector((w, x, y, z))                theta k of a unit quaternion with w >= 0 [rad]
    from_quaternion((w, x, y, z))                R of a unit quaternion
    spring_damper(stiffness, e, kv, omega)       stiffness e - kv omega

Files of this folder:

scalar           the dialect: @kernel, and the functions of a number that it has
so3              rotations as three columns, and vectors
side             the side of a 180° rotation that a law keeps in memory
linalg/          products, eliminations and rotations of small matrices
kinds            Law, Coordinates, Jacobian, Inverse, Impedance, Spring and others
attribution      published, adapted or ours: whose a law is
inputs           Gains, Tuning, Goal; chain: an arm as kernels see it
display          what the book shows of a law: short name, look, family, equation
contender        Contender: a law in its coordinates, on an arm with Jacobian and inverse
euler, spring, shipped, weighting: what several files of a kind share
tracking         goals that move
"""
# ruff: noqa: F401  the public face: what it imports is what it gives

from typing import TYPE_CHECKING

from bench.law.attribution import ADAPTED, OURS, PUBLISHED, YOURS
from bench.law.chain import bias_acceleration, twist
from bench.law.contender import Contender
from bench.law.display import ANGLE, CHORD, LINEAR_MRP, LINEAR_SINE, QUARTER, SINE, TANGENT, Display, Equation, Look
from bench.law.inputs import AT_REST, Gains, Goal, Tuning
from bench.law.kinds import (
    ACTUATOR,
    CONTROL,
    COSTING,
    Baseline,
    Coordinates,
    Impedance,
    Inverse,
    Jacobian,
    Law,
    OnCoordinates,
    Spring,
    Stateful,
    functions_of,
)
from bench.law.linalg import (
    determinant,
    dot_rows,
    exceeds,
    factor,
    gram,
    gram_transposed,
    multiply,
    multiply_transposed,
    orthogonalize,
    solve,
    solve_factored,
    solve_lower,
    solve_upper,
)
from bench.law.scalar import acos, atan2, copysign, cos, kernel, sin, sqrt
from bench.law.side import DELTA, turn_on_kept_side
from bench.law.so3 import (
    IDENTITY,
    Rotation,
    cross,
    dot,
    double_sine,
    driven,
    from_quaternion,
    half_cosine_squared,
    minus,
    quaternion_direction,
    relative,
    rotate,
    rotate_back,
    spring_damper,
    trace,
    turn_matrix,
    turn_quaternion,
)
from bench.law.spring import divide_by_left_jacobian, rotation_vector, times
from bench.law.weighting import GREATEST_GAIN, LENGTH, refuse_seven, smaller_gram, solve_gram, weigh

RENAMED = {"Regulator": "Law", "Compensator": "Law", "Representation": "Coordinates", "State": "Stateful"}

if not TYPE_CHECKING:  # or a type checker would let every name pass

    def __getattr__(name: str):
        """Say what a record is called now, to a law file that imports it by its former name."""
        if name in RENAMED:
            raise ImportError(f"bench.law.{name} is now {RENAMED[name]}; write: from bench.law import {RENAMED[name]}")
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
