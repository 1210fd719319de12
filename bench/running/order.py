"""In which order units run: so that what one thread compiles, no other waits for."""

from collections.abc import Iterable
from typing import Protocol, TypeVar


class OfContender(Protocol):
    """A unit, on the free body, on an arm or in contact."""

    @property
    def contender(self) -> str:
        """Its contender's name."""


One = TypeVar("One", bound=OfContender)


def in_running_order(units: Iterable[One]) -> list[One]:
    """Contender by contender; the first unit of each before the rest of the one before it.

    A contender is compiled when its first unit runs, by one thread at a time: so the others have something to run.
    """
    units = list(units)
    place = {name: i for i, name in enumerate(dict.fromkeys(unit.contender for unit in units))}
    heads = set({unit.contender: unit for unit in reversed(units)}.values())
    return sorted(units, key=lambda unit: (place[unit.contender] - (unit in heads), unit not in heads))
