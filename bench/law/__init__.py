"""What a law is: the dialect it is written in, rotations, small linear algebra, and the records it is made of.

A law imports from here, or from the file that has it:

    from bench.law import Regulator, cross, dot, kernel, sqrt

scalar           the dialect: @kernel, and the functions of a number that it has
so3              rotations as three columns, and vectors
linalg/          products, eliminations and rotations of small matrices
contender        Regulator, Representation, Contender, Gains, Goal
resolved_motion  Jacobian, Inverse: from the tool's acceleration to the joints
impedance        Impedance
chain, weighting an arm as kernels see it; weights of its joints
tracking         goals that move
"""

from bench.law.contender import Contender, Gains, Goal, Regulator, Representation
from bench.law.impedance import Impedance
from bench.law.resolved_motion import Inverse, Jacobian
from bench.law.scalar import acos, atan2, copysign, cos, kernel, sin, sqrt
from bench.law.so3 import Rotation, cross, dot

__all__ = [
    "Contender",
    "Gains",
    "Goal",
    "Impedance",
    "Inverse",
    "Jacobian",
    "Regulator",
    "Representation",
    "Rotation",
    "acos",
    "atan2",
    "copysign",
    "cos",
    "cross",
    "dot",
    "kernel",
    "sin",
    "sqrt",
]
