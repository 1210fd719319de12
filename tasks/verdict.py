"""The judge at work, tick by tick, for slow and compiled loops alike: has it settled, has it failed, how did it end.

The angle is seen as haversine = sin^2(theta/2), which is monotone in theta and exact near 0. The
column `outcome` is what `verdict` returns. The column `settling_time_s` is `Watch.settled_since`,
the first tick since which the angle has stayed in the band, times the control period. The band is
a share of the initial angle (`tasks.rules.RULES`).
"""

from typing import NamedTuple

(SETTLED, STUCK, CREEPING, OSCILLATING, TIMED_OUT, DIVERGED, SINGULAR, SATURATED, CRASHED, HUNG) = range(10)
OUTCOMES = (
    *("settled", "stuck", "creeping", "oscillating", "timed-out", "diverged", "singular", "saturated"),
    *("crashed", "hung"),
)
"""The last two are of a user's law alone: it raised, gave no three numbers, or ended its process; it never returned."""

GOING = -1


class Watch(NamedTuple):
    """What the judge remembers between ticks.

    entries: how often the angle has come inside the band; settled_since: first tick since which it has stayed there;
    slow: whether the body is, now; rest, quiet: for how many ticks on end it has been slow and inside the band, or a
    hundredth of it.
    """

    entries: int
    settled_since: int
    slow: bool
    rest: int
    quiet: int


def first_watch(haversine, band, speed_squared, slow_squared):
    """Return the watch at tick 0."""
    return watched(Watch(0, 0, False, 0, 0), 0, haversine, band, speed_squared, slow_squared)


def watched(watch, tick, haversine, band, speed_squared, slow_squared):
    """Return the watch after seeing angle and speed at one tick. A hundredth of the angle is 1e-4 of its haversine."""
    inside = haversine <= band
    slow = speed_squared <= slow_squared * band
    entries = watch.entries + 1 if inside and watch.settled_since == tick else watch.entries
    settled_since = watch.settled_since if inside else tick + 1
    rest = watch.rest + 1 if inside and slow else 0
    quiet = watch.quiet + 1 if slow and haversine <= 1e-4 * band else 0
    return Watch(entries, settled_since, slow, rest, quiet)


def check_command(squared, limit_squared):
    """Return GOING, SATURATED for too large a command, or SINGULAR if its squared length is not finite [rad^2/s^4]."""
    if squared <= limit_squared:
        return GOING
    return SATURATED if squared - squared == 0.0 else SINGULAR


def check_state(squared, limit_squared):
    """Return GOING, or DIVERGED if the squared speed [rad^2/s^2] is beyond the limit or not finite."""
    return GOING if squared <= limit_squared else DIVERGED


def verdict(failure, watch, tick, rest_ticks, speed_squared, command_squared, rest_speed_squared, rest_command_squared):
    """Return the outcome's code at the end of an episode: a failure, or how it stands at the horizon.

    settled      inside the band and slow, for the last rest_ticks
    stuck        outside the band, without speed or command
    oscillating  came inside the band more than once, or has been inside it for rest_ticks; not at rest there
    creeping     outside the band or only just inside, and slow: on its way, or held off by what is no command of zero
    timed-out    none of these: still moving
    """
    if failure != GOING:
        return failure
    if watch.rest >= rest_ticks:
        return SETTLED
    is_outside = watch.settled_since > tick
    if is_outside and speed_squared <= rest_speed_squared and command_squared <= rest_command_squared:
        return STUCK
    if watch.entries > 1 or tick - watch.settled_since + 1 >= rest_ticks:
        return OSCILLATING
    return CREEPING if watch.slow else TIMED_OUT
