"""Every library's error as the law u = kp e - kv omega on the free body, and controllers as their users run them.

The plant and its gains are the suite's (`ideal-held`: kp = 100, kv = 20, a tick of 1 ms), a tick at a time from Python:
omegadot = u held over the tick, Rdot = [omega]x R (Murphy 1988, 2.6-2.7). Starts are at rest, by angle about AXES, each
from both quaternions where a function takes one; and exact 180° rotations. The judge says what is settled.

The goal is the identity, so that the error is that of the rotation T = R^T. The quaternion of T is carried on, as by an
encoder, so that a function that takes quaternions sees the sign with which the episode began.
"""

import functools
import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from bench.engines.ideal import held_turn, plus
from bench.law.inputs import AT_REST, PAPERS_GAINS
from bench.studies.libraries import turns
from bench.studies.libraries.library import QUATERNION, Controller, Function, answer, quiet
from tasks.base import Quat
from tasks.rules import RULES, ticks

DT_S = 1e-3
HORIZON_S = 20.0
AXES = ((1, 0, 0), (0, 0, -1), (1, 1, 0), (1, -2, 3), (-5, 4, 7))
"""Two of the base, one between them, two of no kind."""
ANGLES_DEG = (1.0, 30.0, 90.0, 150.0, 175.0, 179.0, 179.9)
HALF_TURN_AXES = 40
"""Exact 180° rotations: about the 26 axes of a cube, then drawn ones."""
AWAY_RAD = math.radians(1.0)
"""A body at rest whose command points the short way never increases its angle; one degree is no rounding."""
NEAR = 0.1
"""An episode ends once the angle has stayed under this share of the band for the judge's hold."""
SLOPE_AT_RAD = 1e-3
"""Angle at which the stiffness is measured: each form is its own slope to 1e-6; deadbands of 0.005 are felt as none."""


class Response(NamedTuple):
    """What became of one start: `outcome` is a word of OUTCOMES."""

    outcome: str
    settling_s: float = math.nan
    goes_away: bool = False


OUTCOMES = ("settled", "dead", "lost", "failed")
"""Settled; never moves, by exact rest; still outside the band or moving at the horizon; no number came."""


def response(motion: Iterator[tuple], dt_s: float, horizon_s: float = HORIZON_S) -> Response:
    """Return one episode's response; a motion that ends before the horizon stays at rest."""
    hold, last = ticks(RULES.hold_s, dt_s), ticks(horizon_s, dt_s)
    left, inside, highest, angle0, outside = 0, 0, 0.0, 0.0, 0
    try:
        for tick, quat_wxyz in enumerate(motion):
            now = angle(quat_wxyz)
            if not math.isfinite(now):
                return Response("failed")
            if tick == 0:
                angle0 = now
            highest, left = max(highest, now), tick
            if now > RULES.band_rad(angle0):
                outside = tick
            inside = inside + 1 if now <= NEAR * RULES.band_rad(angle0) else 0
            if inside > hold or tick >= last:
                break
        else:
            if outside == left:
                return Response("dead")
    except Exception:  # whatever a library raises is its answer
        return Response("failed")
    goes_away = highest > angle0 + AWAY_RAD
    if left >= last and left - outside < hold:
        return Response("lost", goes_away=goes_away)
    return Response("settled", (outside + 1) * dt_s, goes_away)


def starts(angle_deg: float) -> Iterator[tuple]:
    """Quaternions (w, x, y, z), w >= 0, of the rotations by an angle; at 180 exactly w = 0."""
    if angle_deg == 180.0:
        found: tuple = turns.half_turns().turns[:HALF_TURN_AXES]
    else:
        half = turns.DIGITS.mpf(angle_deg) * turns.DIGITS.pi / 360
        found = tuple(turns.about(axis, turns.DIGITS.cos(half), turns.DIGITS.sin(half)) for axis in AXES)
    for one in found:
        yield tuple(map(float, one.quat_wxyz))


@quiet
def rows_of(one: Function | Controller) -> list[dict[str, Any]]:
    """Return the rows of an error as a law, or of a controller: one for each angle and sheet of its quaternion."""
    signs, stiffness = {"near": 1.0}, math.nan
    rows: list[dict[str, Any]] = []
    motion: Callable[[Any], Iterator[tuple]]
    if isinstance(one, Function):
        motion, dt_s = functools.partial(accelerated, one, *PAPERS_GAINS, DT_S), DT_S
        signs |= {"antipode": -1.0} if one.takes == QUATERNION else {}
        stiffness = stiffness_ratio(one)
    else:
        motion, dt_s = one.motion, one.dt_s
    for angle_deg in (*ANGLES_DEG, 180.0):
        pull = pull_ratio(one, angle_deg)
        for sheet, sign in signs.items():
            begun = [tuple(sign * part for part in start) for start in starts(angle_deg)]
            found = [response(motion(start), dt_s) for start in begun]
            times = [each.settling_s for each in found if each.outcome == "settled"]
            outcomes = [each.outcome for each in found]
            rows.append(
                {
                    "angle_deg": angle_deg,
                    "sheet": sheet,
                    "starts": len(found),
                    **{word: outcomes.count(word) for word in OUTCOMES},
                    "away": sum(each.goes_away for each in found),
                    "fastest_s": min(times, default=math.nan),
                    "slowest_s": max(times, default=math.nan),
                    "stiffness_ratio": stiffness,
                    "pull_ratio": pull,
                }
            )
    return rows


def pull_ratio(one: Function | Controller, angle_deg: float) -> float:
    """Return the acceleration from rest at an angle over its slope at the smallest; NaN where it is not asked for."""
    if isinstance(one, Function) or one.pull is None:
        return math.nan
    at, near = (one.pull(next(starts(angle))) for angle in (angle_deg, min(ANGLES_DEG)))
    return math.hypot(*at) / math.hypot(*near) * math.radians(min(ANGLES_DEG))


def stiffness_ratio(function: Function) -> float:
    """Stiffness felt over stiffness set: the least e.k / theta at SLOPE_AT_RAD over AXES; NaN where no number comes."""
    half = turns.DIGITS.mpf(SLOPE_AT_RAD) / 2
    ratios = []
    for axis in AXES:
        turn = turns.about(axis, turns.DIGITS.cos(half), turns.DIGITS.sin(half))
        try:
            e = answer(function, turn.quat_wxyz if function.takes == QUATERNION else turn.R)
        except Exception:  # whatever a library raises is its answer
            return math.nan
        ratios.append(float(e @ turn.axis) / turn.angle)
    return min(ratios)


def accelerated(function: Function, kp: float, kv: float, dt_s: float, quat_wxyz: Quat) -> Iterator[Quat]:
    """Yield T, from a quaternion of either sign at rest, under u = kp e - kv omega, until nothing can ever move."""
    omega = AT_REST
    while True:
        yield quat_wxyz
        e = answer(function, np.array(quat_wxyz) if function.takes == QUATERNION else matrix(quat_wxyz))
        u = tuple(kp * float(part) - kv * rate for part, rate in zip(e, omega, strict=True))
        if u == AT_REST == omega:  # the same state and the same answer for ever
            return
        quat_wxyz = after(quat_wxyz, held_turn(omega, u, dt_s))
        omega = plus(omega, dt_s, u)


def driven(velocity: Callable, dt_s: float, quat_wxyz: Quat) -> Iterator[Quat]:
    """T tick by tick under a commanded angular velocity, velocity(T as 3 x 3) [rad/s, base frame], that is held."""
    while True:
        yield quat_wxyz
        omega = tuple(map(float, velocity(matrix(quat_wxyz))))
        if omega == AT_REST:
            return
        quat_wxyz = after(quat_wxyz, tuple(dt_s * part for part in omega))


def after(quat_wxyz: Quat, turn: tuple) -> Quat:
    """T exp(-[turn]x): what is left to go once the body has turned by the base-frame vector `turn`."""
    angle = math.hypot(*turn)
    if angle == 0.0:
        return quat_wxyz
    c, s = math.cos(0.5 * angle), -math.sin(0.5 * angle) / angle
    w, x, y, z = quat_wxyz
    a, b, d = s * turn[0], s * turn[1], s * turn[2]
    product = (
        w * c - x * a - y * b - z * d,
        x * c + w * a + y * d - z * b,
        y * c + w * b + z * a - x * d,
        z * c + w * d + x * b - y * a,
    )
    length = math.hypot(*product)
    return (product[0] / length, product[1] / length, product[2] / length, product[3] / length)


def matrix(quat_wxyz: Quat) -> np.ndarray:
    """R (3 x 3) of a unit quaternion; exactly symmetric where w = 0."""
    w, x, y, z = quat_wxyz
    return np.array(
        (
            (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
            (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
            (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
        )
    )


def angle(quat_wxyz: Quat) -> float:
    """Return the angle of a rotation in [0, pi] rad, of either sign of its quaternion."""
    w, x, y, z = quat_wxyz
    return 2.0 * math.atan2(math.hypot(x, y, z), abs(w))


def conjugate(quat_wxyz: Any) -> Quat:
    """Return the opposite rotation: the body's orientation of what is left to go, and the reverse."""
    w, x, y, z = quat_wxyz
    return (w, -x, -y, -z)
