"""Compose the hooks of tasks/conditions into one function of each kind for the perturbed plant.

A composed function is called as (condition, value, now) -> value. It calls the hooks of all fields
that are not at their defaults, one after another. So one loop is compiled for all conditions.
"""

import sys
from collections.abc import Callable
from inspect import isfunction
from typing import Any

from bench.engines.ideal import angle_between, turned
from bench.law.inputs import Goal
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import IDENTITY, Rotation, dot, turn_quaternion
from tasks.axis import Field, Moment
from tasks.condition import FIELDS, Condition
from tasks.errors import BadValue

LEAD = 2.0
"""Periods that a measurement away from the goal looks ahead."""


VECTOR = (0.5, 1.0, 2.0)
NOW = Moment(1.0, 1e-3, IDENTITY, VECTOR, IDENTITY, VECTOR + VECTOR)
EXAMPLES: dict[str, tuple] = {
    "measured_rate": (VECTOR, NOW, VECTOR),
    "measured_turn": (IDENTITY, NOW, VECTOR),
    "measured_away": (1.0, NOW, 1.0),
    "commanded": (VECTOR, NOW, VECTOR),
    "feedforward": ((VECTOR, VECTOR), NOW, (VECTOR, VECTOR)),
    "goal": (IDENTITY, 1.0, (tuple(IDENTITY), VECTOR, VECTOR)),
}
"""For each kind of hook that is compiled, its second and third argument, and an answer."""


@kernel
def unchanged(condition, value, now):
    """Return the value: where no field has a hook."""
    return value


def compose(**adapters: Callable) -> Callable:
    """Return one function of the hooks of several kinds: all hooks of the first kind come first.

    Args:
        adapters: For each kind of hook, a function that makes a kernel (level, value, now) -> value
            of a hook.
    """
    composed = unchanged
    for kind, adapt in adapters.items():
        for field in FIELDS:
            hook = getattr(field, kind)
            if hook is not None:
                check(field, kind)
                mark(hook)
                composed = _then(composed, field, adapt(hook))
    return composed


def check(field: Field, kind: str) -> None:
    """Raise BadValue if the plant cannot call a hook, or use what it returns."""
    value, now, answer = EXAMPLES[kind]
    level = (1.0, 1.0, 1.0) if isinstance(field.default, tuple) else type(field.default)(1)
    hook = getattr(field, kind)
    try:
        result = hook(level, value, now)
    except (ArithmeticError, ValueError):
        return  # The level of the example may be one that the hook never meets.
    except Exception as error:
        raise BadValue(
            f"{hook.__module__}: {kind} of the field '{field.name}' raises "
            f"{type(error).__name__}: {error} (see Field in tasks/axis.py for its arguments)"
        ) from error
    if not _has_form(result, answer):
        raise BadValue(
            f"{hook.__module__}: {kind} of the field '{field.name}' returns {result!r}; "
            f"allowed are floats in tuples, as in {answer!r}"
        )


def _has_form(result: Any, answer: Any) -> bool:
    if not isinstance(answer, tuple):
        return isinstance(result, float)
    is_as_long = isinstance(result, tuple) and len(result) == len(answer)
    return is_as_long and all(map(_has_form, result, answer))


def mark(hook: Callable) -> None:
    """Mark a hook, and the functions of its file, as code that can be compiled."""
    for function in (hook, *vars(sys.modules[hook.__module__]).values()):
        if isfunction(function):
            kernel(function)


def _then(before: Callable, field: Field, act: Callable) -> Callable:
    name, default = field.name, field.default

    @kernel
    def composed(condition, value, now):
        value = before(condition, value, now)
        level = getattr(condition, name)
        if level != default:
            value = act(level, value, now)
        return value

    return composed


def _as_it_is(hook):
    return hook


def _rate_of(hook):
    @kernel
    def act(level, measured, now):
        return measured[0], hook(level, measured[1], now)

    return act


def _turn_of(hook):
    @kernel
    def act(level, measured, now):
        R, omega = measured
        return turned(R, hook(level, R, now)), omega

    return act


def _away_of(hook):
    @kernel
    def act(level, measured, now):
        R, omega = measured
        size = hook(level, angle_between(R, now.R_d), now)
        if size != 0.0:
            # The body is reported away from the goal as it will be LEAD periods later, so that
            # what turns the body back brakes it, too. Without this, the body swings through 180°
            # farther each time, and gets away.
            ahead = LEAD * now.period_s
            later = turned(R, (ahead * omega[0], ahead * omega[1], ahead * omega[2]))
            _, v, _ = turn_quaternion(later, now.R_d)
            away = -size / sqrt(dot(v, v))
            R = turned(R, (away * v[0], away * v[1], away * v[2]))
        return R, omega

    return act


def _goal_of(hook):
    @kernel
    def act(level, goal, time_s):
        (n, o, a), omega_d, alpha_d = hook(level, goal.R, time_s)
        return Goal(Rotation(n, o, a), omega_d, alpha_d)

    return act


measured = compose(measured_rate=_rate_of, measured_turn=_turn_of, measured_away=_away_of)
"""(condition, (R, omega), now) -> (R, omega) as they are measured. Rates come first: a measurement
away from the goal looks ahead by the measured rate."""

commanded = compose(commanded=_as_it_is)
"""(condition, u, now) -> the command that the motors carry out."""

fed_forward = compose(feedforward=_as_it_is)
"""(condition, (omega_d, alpha_d), now) -> what the law is given of the goal's motion."""

goal_at = compose(goal=_goal_of)
"""(condition, goal at rest, time [s]) -> the goal at that time."""


def inertia_of(condition: Condition) -> tuple:
    """Return the body's principal moments, divided by those of the law's model."""
    moments = (1.0, 1.0, 1.0)
    for hook, level in condition.acting("inertia"):
        moments = hook(level, moments)
    return moments
