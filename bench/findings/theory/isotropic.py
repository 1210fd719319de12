"""The laws that turn about one fixed axis from rest, integrated apart from the benchmark by their scalar equations."""

import functools
import math
from typing import Any

from scipy.integrate import solve_ivp

from bench.law.contenders.registry import all_contenders
from bench.law.display import Equation

TIGHT = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-9}
"""The band's edge is at 7e-4 rad or more and crossed at ten times that in 1 s: times are known to 1e-6 s."""

LEAST_RAD, NEAREST_RAD = math.radians(2.0), math.radians(0.2)
"""Limits of the curves: the least angle, and the least distance from 180°, where some springs are unbounded."""

LONGEST_S = 6.0
"""Three times what the slowest of them takes that near 180°."""

SHORT_S = 1e-3
"""Longest step where a body leaves the band by so little that a longer one steps over it."""

REST = 10.0
"""Angle, and the way that the speed still goes against damping alone, within this part of the band: no spring of these
leaves the band from there, and the integration ends."""

EQUATIONS = {one.name: one.equation for one in all_contenders() if one.equation}
"""contender -> its equation, from its own file; a law that prefers some axes to others has none."""


@functools.cache
def settling(equation: Equation, angle: float, kp: float, kv: float, tolerance: float) -> float:
    """Return the last time [s] at which the angle to the goal is `tolerance` of the initial one [rad]."""

    def rate(_: Any, state: Any) -> Any:
        theta, speed = state
        return speed, -kp * equation.spring(theta) - kv * speed + equation.added(theta, speed, kp, kv)

    def edge(_: Any, state: Any) -> Any:
        return abs(state[0]) - tolerance * angle

    def rest(_: Any, state: Any) -> Any:
        return abs(state[0]) + abs(state[1]) / kv - tolerance * angle / REST

    def turn(_: Any, state: Any) -> Any:
        return state[1]

    rest.terminal = True  # type: ignore[attr-defined]  # how solve_ivp is asked to stop
    first = 2.0 * math.pi - angle if equation.the_long_way else angle
    given = rate, (0.0, LONGEST_S), (first, 0.0)
    found = solve_ivp(*given, events=(edge, rest, turn), **TIGHT)
    last, turns = found.t_events[0][-1], zip(found.t_events[2], found.y_events[2], strict=True)
    if any(time > last and edge(time, state) > 0.0 for time, state in turns):  # out of the band and back in one step
        found = solve_ivp(*given, events=(edge, rest), max_step=SHORT_S, **TIGHT)
    return float(found.t_events[0][-1])
