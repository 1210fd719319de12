"""Signatures of the functions that loops call by pointer, as annotations; each compiler makes its own types of them."""

from typing import Any, NamedTuple

from bench.engines.arrays import Four, Matrix, Three, Vector
from bench.law.chain import Chain, Scratch
from bench.law.control.setpoint import ContactParameters, Rows, Setpoint
from bench.law.inputs import Goal, Tuning
from bench.law.so3 import Rotation


class Signature(NamedTuple):
    """Annotations of the arguments and of the result of a function."""

    parameters: tuple
    returns: Any


EVALUATE = Signature((Rotation, Three, Goal, Tuning, Four), tuple[Three, Four, float])
"""evaluate(R, omega, goal, gains, memory) -> (u, memory, margin): a law as loops on the free body call it."""

ASSEMBLE = Signature((Chain, Goal, Three, Tuning, Four, Matrix, Vector), tuple[Three, Four])
RESOLVE = Signature((Matrix, Vector, Matrix, Vector, int, int, Scratch), None)
MARGIN = Signature((Rotation, Rotation), float)
LIMIT = Signature((Three, float), Three)
DESIGN = Signature((Vector, Matrix, float, Matrix, Scratch), None)
STATEFUL = Signature((Rotation, Three, Goal, Tuning, Four), tuple[Three, Four])
BEGIN_STATE = Signature((Rotation,), Four)
TOUCH = Signature((Chain, Setpoint, Three, Three, Tuning, ContactParameters, Matrix, Rows), None)
"""The other functions that loops call: see `plants`."""
