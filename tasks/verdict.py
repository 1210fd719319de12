"""The judge at work, tick by tick: has it settled, has it failed, how did it end.

Plain functions of numbers, so that the slow loop calls them and the compiled loops compile them: one judge
for every engine. The angle is seen as haversine = sin^2(theta/2), which is monotone in theta and exact near 0.
"""

from typing import NamedTuple

SETTLED, STUCK, TIMED_OUT, DIVERGED, SINGULAR, SATURATED, CRASHED, HUNG = range(8)
OUTCOMES = ("settled", "stuck", "timed-out", "diverged", "singular", "saturated", "crashed", "hung")
"""The last two are of a user's law alone: it raised, gave no three numbers, or ended its process; it never returned."""

GOING = -1


class Watch(NamedTuple):
    """What the judge remembers between ticks.

    entered: the angle has been inside the band; settled_since: first tick since which it has stayed there;
    quiet: for how many ticks on end it has been under a hundredth of the band.
    """

    entered: bool
    settled_since: int
    quiet: int


def first_watch(haversine, band):
    """The watch at tick 0."""
    return watched(Watch(False, 0, 0), 0, haversine, band)


def watched(watch, tick, haversine, band):
    """The watch after seeing the angle at one tick. A hundredth of the angle is 1e-4 of its haversine."""
    inside = haversine <= band
    settled_since = watch.settled_since if inside else tick + 1
    quiet = watch.quiet + 1 if haversine <= 1e-4 * band else 0
    return Watch(watch.entered or inside, settled_since, quiet)


def check_command(squared, limit_squared):
    """GOING, or why a command of this squared length [rad^2/s^4] cannot be applied: beyond the limit, or not finite.

    Not finite is judged of the square, which overflows from 1.3e154 rad/s^2 on.
    """
    if squared <= limit_squared:
        return GOING
    return SATURATED if squared - squared == 0.0 else SINGULAR


def check_state(squared, limit_squared):
    """GOING, or DIVERGED if the squared speed [rad^2/s^2] is beyond the limit or not finite."""
    return GOING if squared <= limit_squared else DIVERGED


def verdict(failure, inside, speed_squared, command_squared, rest_speed_squared, rest_command_squared):
    """The outcome's code at the end of an episode: a failure, or how it stands at the horizon."""
    if failure != GOING:
        return failure
    if inside:
        return SETTLED
    if speed_squared <= rest_speed_squared and command_squared <= rest_command_squared:
        return STUCK
    return TIMED_OUT


COMPILABLE = (first_watch, watched, check_command, check_state, verdict)
"""What a compiled loop needs of this module."""
