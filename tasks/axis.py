"""What a file of tasks/conditions declares: a perturbation of the free body, and the fields of a condition it needs.

Along an axis a number, the level, grows or shrinks. A field is declared by one axis and may be set by others.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from tasks.base import Start, Vector

Value = float | int | Vector


class Field(NamedTuple):
    """A number, a whole number or three numbers of a condition, by the type of its default: the value without effect.

    meaning: with its unit. lasts: whether the perturbation goes on after the goal is reached, so that an episode runs
    to its horizon; it must be said. is_drawn: whether the measurements need random numbers, drawn again each period.
    """

    name: str
    default: Value
    meaning: str
    lasts: bool | None = None
    is_drawn: bool = False


def spread(count: int, seed: int, level: float) -> list[Start]:
    """Return orientations spread evenly over SO(3), at rest: the same at every level."""
    from tasks.starts.uniform import between

    return between(0, count, seed)


class Axis(NamedTuple):
    """A perturbation: the constant AXIS of every tasks/conditions/<name>.py.

    nominal: the level of no perturbation, None if there is none. fields: those that this file declares.
    sets(level) -> {field: its value}; without it the level is the first field's value. starts(count, seed, level) -> as
    many starts.
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
