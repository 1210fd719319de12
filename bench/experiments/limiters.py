"""Limiters of velocity commands: limit(omega, K) -> omega, the part of a commanded angular velocity that is passed on.

omega is in the base frame [rad/s]. K is the law's gain [1/s], for what a limiter says of the error.
"""

from collections.abc import Callable
from typing import NamedTuple

from bench.law import kernel
from bench.law.shipped import clipped, shortened

GREATEST_RATE = 2.0
"""[rad/s]. What limiters pass at most: robot arms turn their tools at 1 to 3 rad/s; a 180° rotation takes 1.6 s."""

BAND = 5e-3
"""[rad]. Errors below it command nothing behind the deadband."""


class Limiter(NamedTuple):
    """A title, and limit(omega, K) -> omega."""

    title: str
    limit: Callable


@kernel
def clamp_axes(omega, K):
    """Cut each component that exceeds the bound; the others stay, so that the command turns off its direction.

    Far from the goal the path is longer: its axis is up to 54.7 degrees, the angle of a cube's diagonal to its edge,
    off that of the shortest path; how much depends on the base frame.
    Source: utiasDSL/crisp_controllers 5075de9, src/cartesian_controller.cpp, which cuts the error so (limit_error).
    """
    return clipped(omega, GREATEST_RATE)


@kernel
def pass_beyond(x, least):
    """Return x, or 0 within [-least, least]."""
    if -least <= x <= least:
        return 0.0 * x
    return x


@kernel
def drop_small_errors(omega, K):
    """Pass each component, or 0 where the error that it is K times of is within BAND.

    The tool stops up to sqrt(3) BAND from the goal, 0.5 degrees: outside the settling band of the nearest starts.
    Source: UT-Austin-RPL/deoxys_control f2932a0, osc_impedance.cpp, whose band is of the quaternion's vector part.
    """
    least = BAND * K
    return (pass_beyond(omega[0], least), pass_beyond(omega[1], least), pass_beyond(omega[2], least))


@kernel
def pass_all(omega, K):
    """Return omega as it is, which far from the goal may be more than a robot turns."""
    return omega


@kernel
def clamp_norm(omega, K):
    """Shorten a command beyond the bound: min(1, GREATEST_RATE/|omega|) omega; the path is the law's own.

    Source: fzi-forschungszentrum-informatik/cartesian_controllers 520baf4, computeMotionError, which shortens the error
    so, at 1 rad whatever the gain.
    """
    return shortened(omega, GREATEST_RATE)


NONE = "none"
"""The limiter that limits nothing."""

LIMITERS = {
    "axis-clamp": Limiter("Clamp per axis", clamp_axes),
    "deadband": Limiter("Deadband per axis", drop_small_errors),
    NONE: Limiter("None", pass_all),
    "norm-clamp": Limiter("Norm clamp", clamp_norm),
}
"""Limiters by the word that rows have."""
