"""Controllers of free bodies: a law that commands the angular acceleration."""

from typing import Any, NamedTuple

from bench.engines.loop import NO_ACT, Act, Controller, pass_on
from bench.law.scalar import kernel
from bench.law.so3 import dot
from tasks.verdict import check_command


class Law(NamedTuple):
    """evaluate(R, omega, goal, gains, memory) -> (u, memory, margin)."""

    evaluate: Any
    second: Any
    third: Any


@kernel
def begin(laws, memory0, sensed):
    """Start with the law's own memory, and no command."""
    return memory0, NO_ACT


@kernel
def accelerate(laws, body, desk, state, sensed, now, gains, memory, numbers):
    """Command what the law says."""
    u, memory, margin = laws.evaluate(sensed.R, sensed.omega, sensed.goal, gains, memory)
    squared = dot(u, u)
    return Act(u, u, squared, margin, check_command(squared, numbers.command_limit_squared)), memory


ACCELERATION = Controller(Law, pass_on, begin, accelerate)
