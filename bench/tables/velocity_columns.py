"""Tables of robots that are commanded by velocities: episodes of first-order laws, and how far K dt may be raised."""

from bench.tables.column import SINGLE, Column, numbers, words
from bench.tables.motion_columns import CONTENDER, JUDGED

SHARE = numbers("1", "of K that is used: 0.5 writes the quaternion's vector part where the law has twice it", "share")


def velocity_columns() -> list[Column]:
    """velocity.parquet: first-order laws omega = K f(R, R_d), f a law's command at rest over kp; a row an episode."""
    seen = {
        "path_ratio": ("1", "way turned over the initial angle"),
        "furthest_rad": ("rad", "greatest angle to the goal"),
        "bent_rad": ("rad", "greatest angle by which the limiter turned a command off its direction"),
        "peak_omega": ("rad/s", "greatest angular velocity commanded, as limited"),
        "peak_rate": ("rad/s", "greatest length of the vector of joint rates commanded; null on the free body"),
        "off_m": ("m", "greatest distance of the tool from its place; null on the free body"),
        "rounding_change": (
            "1",
            "on arms, largest relative change of this row's numbers when its joints start 1e-12 rad further; null on "
            "the free body",
        ),
    }
    return [
        *words(suite="plan the row belongs to", arm="manipulator; empty for the free body"),
        *CONTENDER,
        *SHARE,
        *words(limiter="what stands between the law and the robot"),
        *numbers("s", "time constant of the joints' servos; 0 of servos that follow at once", "lag_s"),
        *words(start_set="family of starts, all at rest", start_id="start within its family"),
        *numbers("rad", "initial angle to the goal, by the judge", "angle0_rad"),
        *numbers("1/s", "gain of the law, share left out", "gain"),
        *numbers("s", "control period", "dt_s"),
        *numbers("s", "longest time simulated", "horizon_s"),
        *JUDGED,
        *(Column(name, SINGLE, unit, meaning) for name, (unit, meaning) in seen.items()),
        *words(outcome_beside="on arms, the other outcome 1e-12 rad beside: rounding decides; empty if there is none"),
    ]


def velocity_limit_columns() -> list[Column]:
    """velocity-limits.parquet: the largest K dt at which a first-order law is stable, bisected.

    What theory says of it: bench/findings/theory/velocity_limits.py.
    """
    return [
        *words(arm="manipulator; empty for the free body"),
        *CONTENDER,
        *SHARE,
        *words(
            reach="near: errors of 1e-3 rad die out; far: no tick takes any start further away than it was, from 1e-3 "
            "rad to 1e-3 rad short of 180 degrees"
        ),
        *numbers("1", "time constant of the servos over the control period", "lag_ticks"),
        *numbers("1", "largest K dt, bisected", "k_dt"),
    ]
