"""The numbers of the rules, each with its derivation; verdict.py applies them.

Settling time: the first time after which the angle stays inside the band to the horizon. Settled is at rest: for the
last `hold_s` the angle has been inside the band, and |omega| at most what crosses half the band in `hold_s`.
"""

from __future__ import annotations

import math
from typing import NamedTuple


def band_rad(angle0: float, tolerance: float, floor_rad: float, at_goal_rad: float) -> float:
    """Return the half width of the settling band [rad]."""
    return floor_rad if angle0 < at_goal_rad else tolerance * angle0


class Rules(NamedTuple):
    """When an episode is settled, stuck, or has failed."""

    # The 2 % criterion of control engineering; the paper says "settling time" and states no band.
    tolerance: float = 0.02
    # Band of a start at the goal: 2 % of one radian.
    floor_rad: float = 0.02
    # A start nearer than this is at the goal. 2 % of it, 2e-8 rad, is just above sqrt(2^-53) = 1.1e-8 rad,
    # the rotation below which 1 - theta^2/2 rounds to 1 and the diagonal of R no longer changes.
    at_goal_rad: float = 1e-6
    # How long a body must be at rest to be settled; an engine may stop early once the angle has stayed under a
    # hundredth of the band for as long. The gains (100, 20) put a double pole at -10/s: 0.25 s is 2.5 of its time
    # constants, too long for a response that only crosses the goal, and short beside its settling time of 0.58 s.
    hold_s: float = 0.25
    # |u| beyond any actuator: held for a 1 ms tick it adds 1,000 rad/s, a whole radian of motion in the next
    # tick. Spring and damping of the paper's gains stay under 100 sqrt(3) pi + 20 * 20 = 944 rad/s^2.
    command_limit: float = 1e6
    # |(tau_i / rated_i)| of an arm's torques, each over its motor's rated torque: beyond any motor. The gains
    # (100, 20) ask for up to 100 pi rad/s^2 of the tool; with the condition number of 30 that a clear path may have
    # a heavily geared wrist (the Jaco's 2 kg m^2 behind 6.8 N m) then takes some thousand times its rated torque, and
    # only singularities ask for ten times that.
    torque_limit: float = 1e4
    # |omega| that turns 10 rad in a 1 ms tick: the orientation can no longer be followed.
    speed_limit: float = 1e4
    # At rest: in a horizon of 20 s a body of this speed moves no further than floor_rad ...
    rest_speed: float = 1e-3
    # ... and this command changes its speed by no more than rest_speed in one time constant, 1/sqrt(Kp).
    rest_command: float = 1e-2

    def band_rad(self, angle0: float) -> float:
        """Half width of the settling band [rad] of an episode that begins at this angle to its goal [rad]."""
        return band_rad(angle0, self.tolerance, self.floor_rad, self.at_goal_rad)

    def band_haversine(self, angle0: float) -> float:
        """Return the band as sin^2(band/2), to compare with `truth.haversine`."""
        return math.sin(self.band_rad(angle0) / 2.0) ** 2

    @property
    def slow_squared(self) -> float:
        """|omega|^2 over the band's haversine up to which a body is slow [1/s^2]: (2 sin(band/2)/hold_s)^2 over it."""
        return 4.0 / self.hold_s**2

    def hold_ticks(self, dt: float) -> int:
        """Return the hold window in control periods."""
        return ticks(self.hold_s, dt)


RULES = Rules()


def ticks(seconds: float, dt: float) -> int:
    """Control periods in a stretch of time: seconds/dt to the nearest whole number, at least 1."""
    return max(1, math.floor(seconds / dt + 0.5))
