"""Put the conditions of an episode on the free body together from the perturbations of tasks/conditions.

By default a law is called every millisecond and given the truth at once.
"""

from __future__ import annotations

import functools
from collections import namedtuple
from typing import Any

from tasks import conditions
from tasks.axis import Axis, Field
from tasks.discovery import constants
from tasks.errors import BadValue


@functools.cache
def known_axes() -> dict[str, Axis]:
    """Return every perturbation by its name, sorted."""
    return constants(conditions, "AXIS")


def declared_fields(axes: dict[str, Axis]) -> tuple[Field, ...]:
    """Return the fields that axes declare, in their order; BadValue if a declaration has a fault."""
    found: dict[str, Field] = {}
    for name, axis in axes.items():
        for field in axis.fields:
            where = f"tasks/conditions/{name.replace('-', '_')}.py: the field '{field.name}'"
            if field.lasts is None:
                raise BadValue(
                    f"{where} does not say whether its perturbation lasts; give lasts=True if it goes on after the "
                    "goal is reached, so that an episode runs to its horizon, else lasts=False"
                )
            if field.name in found:
                raise BadValue(f"{where} is declared by two files; choose another name, or set the one that exists")
            if not isinstance(field.default, float | int) and len(field.default) != 3:
                raise BadValue(f"{where} must be a number or three numbers, not {field.default!r}")
            found[field.name] = field
    return tuple(found.values())


FIELDS = declared_fields(known_axes())

_record: Any = namedtuple  # which a type checker cannot follow
_VALUES: Any = _record("_record", [one.name for one in FIELDS], defaults=[one.default for one in FIELDS])


class Condition(_VALUES):
    """How an episode differs from the ideal one: a value for each of FIELDS, which say what they mean."""

    __slots__ = ()

    def _has(self, kind: str) -> bool:
        return any(value != one.default for value, one in zip(self, FIELDS, strict=True) if getattr(one, kind))

    @property
    def is_noisy(self) -> bool:
        """Tell whether measurements are drawn."""
        return self._has("is_drawn")

    @property
    def lasts(self) -> bool:
        """Tell whether the perturbation goes on after the goal is reached, so that an episode runs to its horizon."""
        return self._has("lasts")


def condition_at(axis: Axis, level: float) -> Condition:
    """Return the condition at a level of an axis; BadValue if it sets a field that no file declares."""
    changes = axis.changes(level)
    for name in changes.keys() - set(Condition._fields):
        raise BadValue(
            f"the axis '{axis.name}' sets '{name}', a field that no file of tasks/conditions declares; declared are "
            f"{', '.join(Condition._fields)} (declare it in `fields`)"
        )
    return Condition(**changes)
