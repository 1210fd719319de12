"""What a law is: the dialect it is written in, rotations, small linear algebra, and the records it is made of.

Whoever writes a law, coordinates, a Jacobian, an inverse, an impedance or a spring imports from
here alone:

    from bench.law import Regulator, cross, dot, kernel, sqrt

scalar           the dialect: @kernel, and the functions of a number that it has
so3              rotations as three columns, and vectors
linalg/          products, eliminations and rotations of small matrices
contender        Regulator, Contender, Gains, Goal
representation   Representation; euler: what Euler angles share
compensator      Compensator: a law with a state of its own
resolved_motion  Jacobian, Inverse: from the tool's acceleration to the joints
impedance        Impedance
spring           Spring, of a pose or of a rotation alone
shipped          Shipped: a controller as its authors set it, and the law it makes
equation, look   what the book shows of a law: its scalar equation, and how it is drawn
chain, weighting an arm as kernels see it; weights of its joints
tracking         goals that move
"""
# ruff: noqa: F401  the public face: what it imports is what it gives

from bench.law.chain import bias_acceleration, twist
from bench.law.compensator import Compensator
from bench.law.contender import AT_REST, Contender, Gains, Goal, Regulator
from bench.law.equation import ANGLE, CHORD, LINEAR_MRP, LINEAR_SINE, QUARTER, SINE, TANGENT, Equation
from bench.law.impedance import Impedance, driven
from bench.law.linalg import (
    determinant,
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
from bench.law.look import Look
from bench.law.representation import Representation
from bench.law.resolved_motion import Inverse, Jacobian
from bench.law.scalar import acos, atan2, copysign, cos, kernel, sin, sqrt
from bench.law.so3 import (
    IDENTITY,
    Rotation,
    cross,
    dot,
    double_sine,
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
from bench.law.spring import Spring, divide_by_left_jacobian, rotation_vector, times
from bench.law.weighting import GREATEST_GAIN, LENGTH, smaller_gram, solve_gram, weigh
