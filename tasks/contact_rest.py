"""When a hand in contact is at rest: the rule by which episodes that have an end end early.

A hand is at rest if for REST.hold_s, and after the place it is held at has stopped, it has stayed as near to where it
then was as the speeds below would take it in that time.
"""

from typing import NamedTuple

from tasks.rules import RULES, ticks


class Rest(NamedTuple):
    """Bounds of rest.

    speed [m/s], rate [rad/s]: over the longest horizon, 12 s, what is slower moves by less than 0.12 mm and 0.07
    degrees, about what contacts give way under 30 N. hold_s: as for settling. A shiver of 2.5 micrometres is rest.
    """

    speed: float = 1e-5
    rate: float = 1e-4
    hold_s: float = RULES.hold_s


REST = Rest()
HORIZON_S = 12.0
"""Horizon of tasks that have an end [s]. A tool on the paper's gains takes some 2 s to lie down; one whose coordinates
let a sixth of the moment through, six times that."""

WINDOW_S = 2.5
"""From the first touch on, over which errors are averaged [s]: an average that went on as long as an episode does would
say when it ended."""


class RestNumbers(NamedTuple):
    """The rule at a control period: first tick at which rest counts, ticks on end (0: never), squared bounds.

    moved_squared [m^2]; turned_squared: of |R - R'|^2 over all elements, 2 angle^2.
    """

    first: int
    ticks: int
    moved_squared: float
    turned_squared: float


def rest_numbers(rests: bool, moves_s: float, dt: float) -> RestNumbers:
    """Return the rule for an episode whose place stops moving at moves_s; that of none if it has no end."""
    if not rests:
        return RestNumbers(0, 0, 0.0, 0.0)
    moved, turned = REST.speed * REST.hold_s, REST.rate * REST.hold_s
    return RestNumbers(ticks(moves_s, dt), ticks(REST.hold_s, dt), moved * moved, 2.0 * turned * turned)


def has_left(rule, tick, p, R, place, frame):
    """Tell whether a hand at p, R is not at rest where it was: place, frame. Then rest is counted from zero."""
    x, y, z = p[0] - place[0], p[1] - place[1], p[2] - place[2]
    if tick < rule.first or x * x + y * y + z * z > rule.moved_squared:
        return True
    turned = _distance_squared(R.n, frame.n) + _distance_squared(R.o, frame.o)
    return turned + _distance_squared(R.a, frame.a) > rule.turned_squared


def _distance_squared(column, before):
    x, y, z = column[0] - before[0], column[1] - before[1], column[2] - before[2]
    return x * x + y * y + z * z
