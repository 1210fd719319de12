"""What a file of tasks/conditions declares: a perturbation of the free body, and the fields of a condition it needs.

Along an axis a number, the level, grows or shrinks. A field is declared by one axis and may be set by others.
CONTRIBUTING.md shows the whole file of a perturbation.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from tasks.base import Start, Vector

Value = float | int | Vector


class Moment(NamedTuple):
    """What a hook can read of a tick of the control: true values in the base frame.

    Attributes:
        time_s: Time since the start [s].
        period_s: Control period [s].
        R: Orientation of the body, by its columns n, o, a.
        omega: Angular velocity of the body [rad/s].
        R_d: Orientation of the goal, by its columns.
        noise: Six numbers of unit standard deviation, drawn again each control period if the field
            has is_drawn=True.
    """

    time_s: float
    period_s: float
    R: tuple
    omega: tuple
    R_d: tuple
    noise: tuple


class LoopFields(NamedTuple):
    """Fields that the loop itself reads, to call the hooks in time, and to show limits to the law.

    Attributes:
        period_s: Time from one command to the next [s].
        delay_s: Time from a measurement to the effect of the command [s]; the law can read it.
        jump_s: Time at which the goal leaves the base frame for the start's goal [s]; 0 for none.
        jump_resets: 1 if the law's memory is then reset to its initial value.
        bound: Greatest length of a command [rad/s^2]; the law can read it.
    """

    period_s: float = 1e-3
    delay_s: float = 0.0
    jump_s: float = 0.0
    jump_resets: int = 0
    bound: float = math.inf


class Field(NamedTuple):
    """A number, a whole number or three numbers of a condition, and the hooks by which it acts.

    A hook is a function. The perturbed plant calls it wherever the field differs from its default;
    where several fields have the same hook, in the order of their files' names. Its first argument
    is the value of the field, the second is what it changes, and `now` is a Moment. It is compiled:
    it is made of floats and tuples (the dialect of bench/law/scalar.py, with the functions of
    `math`), and calls only functions that its file defines or imports by name. Vectors are in the
    base frame.

    Attributes:
        name: Name of the field in a Condition.
        default: The value without effect.
        meaning: What the number is, with its unit.
        lasts: Whether the perturbation goes on after the goal is reached, so that an episode runs
            to its horizon. It must be said.
        is_drawn: Whether its hooks read random numbers.
        in_loop: Whether the loop itself reads it; its name is then in LoopFields.
        measured_rate: (level, omega, now) -> the angular velocity that is measured [rad/s].
        measured_turn: (level, R, now) -> the rotation vector [rad] by which the measured
            orientation is turned from R.
        measured_away: (level, angle, now) -> how far [rad] the orientation is measured away from
            the goal as it will be two control periods later. angle: between the goal and the
            orientation that is measured otherwise [rad].
        commanded: (level, u, now) -> the command that the motors carry out [rad/s^2].
        feedforward: (level, (omega_d, alpha_d), now) -> the goal's angular velocity [rad/s] and
            angular acceleration [rad/s^2] that the law is given.
        goal: (level, R_0, time_s) -> (columns n, o, a of R_d), omega_d, alpha_d: a goal that moves
            from R_0. Of one condition only one field with this hook may differ from its default.
        inertia: (level, moments) -> the body's principal moments, divided by those of the law's
            model. It is called once, before the episodes.
    """

    name: str
    default: Value
    meaning: str
    lasts: bool | None = None
    is_drawn: bool = False
    in_loop: bool = False
    measured_rate: Callable | None = None
    measured_turn: Callable | None = None
    measured_away: Callable | None = None
    commanded: Callable | None = None
    feedforward: Callable | None = None
    goal: Callable | None = None
    inertia: Callable | None = None


HOOKS = Field._fields[Field._fields.index("measured_rate") :]
"""Names of the hooks."""


def spread(count: int, seed: int, level: float) -> list[Start]:
    """Return orientations spread evenly over SO(3), at rest: the same at every level."""
    from tasks.starts.uniform import between

    return between(0, count, seed)


class Axis(NamedTuple):
    """A perturbation: the constant AXIS of every tasks/conditions/<name>.py.

    Attributes:
        name: The file's name, with dashes.
        title: What it is, in a few words.
        unit: Unit of the level.
        levels: The levels at which laws are run, in ascending order.
        nominal: The level of no perturbation, one of the levels; None if there is none.
        fields: The fields that this file declares.
        sets: sets(level) -> {field: its value}, of any file's fields; without it the level is the
            value of the first field.
        starts: starts(count, seed, level) -> as many starts; by default evenly spread, at rest.
    """

    name: str
    title: str
    unit: str
    levels: tuple[float, ...]
    nominal: float | None
    fields: tuple[Field, ...] = ()
    sets: Callable[[float], dict[str, Value]] | None = None
    starts: Callable[[int, int, float], list[Start]] = spread

    def changes(self, level: float) -> dict[str, Value]:
        """Return the values of fields at a level."""
        return self.sets(level) if self.sets else {one.name: level for one in self.fields[:1]}
