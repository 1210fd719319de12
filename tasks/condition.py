"""What a controller meets outside the paper: conditions of an episode on the free body, one axis a perturbation.

An axis is one file of tasks/conditions with a constant AXIS; along it a number, the level, grows or shrinks. At the
nominal level of every axis the condition is the default one: a law asked every millisecond, given the truth at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from tasks.base import Start, Vector

NO_FEEDFORWARD, RATE, RATE_AND_ACCELERATION = range(3)
"""What a law is given of a moving goal beside where it is."""


class Condition(NamedTuple):
    """How an episode differs from the ideal one.

    period_s: from one command to the next; between them it is held. delay_s: from measuring to the command's effect.
    attitude_noise, rate_noise: standard deviation about each axis, drawn anew each period [rad, rad/s].
    worst_attitude_error: within this angle [rad] of a 180-degree rotation the body is reported so much farther from the
    goal than it is, so that it seems to lie on the other side. bound: what |u| is cut to [rad/s^2]. inertia: true
    principal moments over the law's model of them, along the body's axes. reference_amplitude: peak rate [rad/s] of a
    goal that moves (`moving_goal`), and feedforward: what the law is given of its motion. peak: gains such that the
    law's greatest command from rest is this [rad/s^2], critically damped; 0: the gains as they are.
    """

    period_s: float = 1e-3
    delay_s: float = 0.0
    attitude_noise: float = 0.0
    rate_noise: float = 0.0
    worst_attitude_error: float = 0.0
    bound: float = math.inf
    inertia: Vector = (1.0, 1.0, 1.0)
    reference_amplitude: float = 0.0
    feedforward: int = RATE_AND_ACCELERATION
    peak: float = 0.0

    @property
    def is_noisy(self) -> bool:
        """Whether measurements are drawn."""
        return self.attitude_noise > 0.0 or self.rate_noise > 0.0

    @property
    def lasts(self) -> bool:
        """Whether the perturbation goes on after the goal is reached, so that an episode must run to its horizon."""
        return self.is_noisy or self.reference_amplitude > 0.0


def spread(count: int, seed: int, level: float) -> list[Start]:
    """Orientations spread evenly over SO(3), at rest: the same at every level."""
    from tasks.starts.uniform import build

    return build(count, seed)


class Axis(NamedTuple):
    """A perturbation: the constant AXIS of every tasks/conditions/<name>.py.

    at(level) -> Condition; starts(count, seed, level) -> as many starts; nominal: the level of no perturbation, None if
    there is none.
    """

    name: str
    title: str
    unit: str
    levels: tuple[float, ...]
    nominal: float | None
    at: Callable[[float], Condition]
    starts: Callable[[int, int, float], list[Start]] = spread
