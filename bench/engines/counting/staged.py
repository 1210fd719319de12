"""A representation whose functions tell the tally which stage of the tick they are.

`OnCoordinates.law_in` is handed this in place of the representation: the law is the same source. A law on R takes
no representation and is all `regulate`.
"""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, cast

from bench.engines.counting.counted import Tally
from bench.law.contender import Contender, bind
from bench.law.kinds import Coordinates

STAGE_OF = {
    "goal_chart": "goal",
    "chart": "represent",
    "chart_of": "represent",
    "to_matrix": "represent",
    "rates": "represent",
    "angular_velocity": "represent",
    "generalized": "represent",
    "margin": "represent",
    "accelerate": "linearize",
    "differentiate": "jacobian",
    "differentiate_twice": "jacobian",
}
"""Function of coordinates -> stage."""


def law_of(contender: Contender, tally: Tally) -> Callable:
    """Return the contender's law, its coordinates staged on this tally."""
    if contender.representation is None:
        return contender.law
    return bind(contender.regulator, staged(contender.representation, tally))


def staged(representation: Coordinates, tally: Tally) -> Coordinates:
    """Return a stand-in with the same fields, each function in its stage."""
    fields = representation._asdict()
    for name, stage in STAGE_OF.items():
        function = getattr(representation, name)
        fields[name] = None if function is None else in_stage(tally, stage, function)
    return cast(Coordinates, SimpleNamespace(**fields))  # goal_chart is a property there, and cannot be replaced


def in_stage(tally: Tally, stage: str, function: Callable) -> Callable:
    """Return the function, its operations counted in that stage."""

    def call(*numbers: Any) -> Any:
        before, tally.stage = tally.stage, stage
        try:
            return function(*numbers)
        finally:
            tally.stage = before

    return call
