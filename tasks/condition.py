"""Put the conditions of an episode on the free body together from the perturbations of tasks/conditions.

By default a law is called every millisecond and given the truth at once.
"""

from __future__ import annotations

import functools
from collections import namedtuple
from typing import Any

from tasks import conditions
from tasks.axis import HOOKS, Axis, Field, LoopFields, Value, spread
from tasks.discovery import constants
from tasks.errors import BadValue


@functools.cache
def known_axes() -> dict[str, Axis]:
    """Return every perturbation by its name, sorted."""
    return constants(conditions, "AXIS")


def declared_fields(axes: dict[str, Axis]) -> tuple[Field, ...]:
    """Return the fields that axes declare, in their order; BadValue if a declaration has a fault."""
    fields: dict[str, Field] = {}
    for name, axis in axes.items():
        file = f"tasks/conditions/{name.replace('-', '_')}.py"
        if not axis.fields and axis.sets is None and axis.starts is spread:
            raise BadValue(
                f"{file}: AXIS has neither fields nor sets nor starts, so it would perturb nothing "
                "(try: a Field with a hook, as CONTRIBUTING.md shows, or set another file's field)"
            )
        for field in axis.fields:
            reason = _find_fault(field)
            if field.name in fields:
                reason = "is declared by two files; choose another name, or set the one that exists"
            if reason:
                raise BadValue(f"{file}: the field '{field.name}' {reason}")
            fields[field.name] = field
    return tuple(fields.values())


def _find_fault(field: Field) -> str:
    """Return why a field is refused, and the cure; "" if it is not."""
    if field.lasts is None:
        return (
            "does not say whether its perturbation lasts; give lasts=True if it goes on after the "
            "goal is reached, so that an episode runs to its horizon, else lasts=False"
        )
    if isinstance(field.default, tuple) and len([*field.default]) != 3:
        return f"must be a number or three numbers, not {field.default!r}"
    if field.in_loop:
        is_read, known = field.name in LoopFields._fields, ", ".join(LoopFields._fields)
        return "" if is_read else f"is not read by the loop, which reads {known} (give it a hook)"
    if not any(getattr(field, hook) for hook in HOOKS):
        return (
            f"has no hook, so it would perturb nothing; the hooks are {', '.join(HOOKS)} (see "
            "tasks/axis.py) (try in the field: "
            "measured_rate=lambda level, omega, now: (omega[0] + level, omega[1], omega[2]))"
        )
    return ""


FIELDS = declared_fields(known_axes())

_record: Any = namedtuple  # which a type checker cannot follow
_VALUES: Any = _record("_record", [one.name for one in FIELDS], defaults=[one.default for one in FIELDS])


class Condition(_VALUES):
    """How an episode differs from the ideal one: a value for each of FIELDS, which say what they mean."""

    __slots__ = ()

    def acting(self, kind: str) -> list[tuple[Any, Value]]:
        """Return an attribute and the value of each field that has it and differs from its default."""
        values = zip(FIELDS, self, strict=True)
        changed = [(getattr(field, kind), value) for field, value in values if value != field.default]
        return [pair for pair in changed if pair[0]]

    @property
    def is_noisy(self) -> bool:
        """Tell whether measurements are drawn."""
        return bool(self.acting("is_drawn"))

    @property
    def lasts(self) -> bool:
        """Tell whether the perturbation goes on after the goal is reached, so that an episode runs to its horizon."""
        return bool(self.acting("lasts"))

    @property
    def loop(self) -> LoopFields:
        """Return the values that the loop reads."""
        read = [field.name for field in FIELDS if field.in_loop]
        return LoopFields(**{name: getattr(self, name) for name in read})


def condition_at(axis: Axis, level: float) -> Condition:
    """Return the condition at a level of an axis; BadValue if it sets a field that no file declares."""
    changes = axis.changes(level)
    for name in changes.keys() - set(Condition._fields):
        raise BadValue(
            f"the axis '{axis.name}' sets '{name}', a field that no file of tasks/conditions declares; declared are "
            f"{', '.join(Condition._fields)} (declare it in `fields`)"
        )
    condition = Condition(**changes)
    if len(condition.acting("goal")) > 1:
        raise BadValue(
            f"the axis '{axis.name}' sets {', '.join(changes)}, of which more than one moves the "
            "goal; set one of them alone"
        )
    return condition
