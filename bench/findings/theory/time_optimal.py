"""The floor: the least time in which a bounded command settles a body that turns, whatever the law.

Settled is as the benchmark's rules have it (`tasks/rules.py`): the angle has come into a band of half
width b = 2 % of the first angle, whatever the spin, and stays there. The rest within the band that
the rules ask for at the end of an episode may come later, and costs no settling time. |u| <= a.

What is known, from the surest on:

1. `certain_least_time` is proved: no command settles earlier, whatever the direction of the spin.
2. From rest the time is a closed form, T = 2 sqrt((theta + b)/a) - 2 sqrt(b/a), about the fixed axis of
   the turn (`least_time_about_axis`). It is attained, and 1 is below it by 1.9e-4 of it at most.
3. With a spin about the axis of the turn a closed form holds for motions about that axis. Where the
   spin is towards the goal and no braking overshoots it is the time of 1 again. Elsewhere a motion
   that leaves the axis may be faster.
4. With any other spin the shortest extremal that was found (`extremals.py`): the bound allows that
   motion, so that the least time is no longer. That none is shorter is not proved.

Limitations: the command's size is bounded, not each of its components; the inertia is even and
known; the command acts from 0 on, without delay or period; the goal rests; the start is not at the
goal (`RULES.at_goal_rad`), where the rules have another band. In 4 the band is seen as flat: of the
tests' 20 starts the collocation, which does not see it so, is faster by 1e-4 of the time at most. Where
no way to the band is found, 4 is the way to rest: up to 0.6 sqrt(b/a) too long; 95 % of such nodes of the
table are below 0.15 rad.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from bench.findings.theory.extremals import (
    SOLVED,
    STEPS,
    Bodies,
    draw_guesses,
    improve,
    miss_band,
    miss_rest,
)
from tasks.rules import RULES

GUESSES = 60
"""Drawn guesses: enough up to speeds of 4 sqrt(a). With 40, no collocation of the tests' 20 starts is faster. Of faster
starts that were tried some missed the fastest motion, by up to 19 %; 300 guesses found it. The table of
`bench.findings.floor` has it from neighbours."""

STEPS_PER_SPEED = 10.0
"""Steps of the integration, at least, for each sqrt(a) of speed: the body turns 0.1 w T in a step."""

LANDING = 2.0
"""Time from the arrival straight in to the stop at the far edge, over sqrt(b)."""

WIDENINGS = (8.0, 4.0, 2.0, 1.0)
"""Bands over the one that is meant, in turn, if it cannot be met at once."""

LEAST_SHARE = 0.3
"""Share of a time that is left, at least, where a guess of an arrival is made of it."""

APART = 1e-3
"""Relative difference of times from which on two extremals are two."""

AT_GOAL = 1e-12
"""Angle [rad] up to which a turn has no axis."""

Numbers = np.ndarray | float
"""A number, or an array of them."""


class Extremals(NamedTuple):
    """Extremals of one body, the shortest first: their times [1/sqrt(a)] and unknowns, shape (7, n)."""

    times: np.ndarray
    unknown: np.ndarray


def certain_least_time(
    angle: Numbers, speed: Numbers, acceleration: Numbers, tolerance: float = RULES.tolerance
) -> Numbers:
    """Return a time [s] before which no command settles the body, whatever the spin's direction.

    The angle falls by |omega| at most, and |omega| is at most w + a t and, with the speed s at the time
    T of arrival, s + a (T - t). So T >= (2 v - w - s)/a with v^2 = a (theta - b) + (w^2 + s^2)/2, and
    T >= (w - s)/a. A body stays in the band only if s^2 <= 4 a sin(b)/cos(b)^2: let f be twice the part
    along omega(T) of the vector of the quaternion of the turn since then; f' >= s cos(b) - a t, and f at
    its greatest, s^2 cos(b)^2/(2 a), is at most 2 sin(b). With b = 0 it is the rest at the goal.

    Args:
        angle: to the goal, theta [rad].
        speed: |omega| [rad/s].
        acceleration: bound of |u|, a [rad/s^2].
        tolerance: b over theta.
    """
    band = tolerance * angle
    slowest = 2.0 * np.sqrt(acceleration * np.sin(band)) / np.cos(band)
    kinetic = 0.5 * (speed**2 + slowest**2)
    highest = np.sqrt(acceleration * (angle - band) + kinetic)
    turning = 2.0 * highest - speed - slowest
    braking = speed - slowest
    return np.maximum(0.0, np.maximum(turning, braking)) / acceleration


def least_time_about_axis(
    angle: float, rate: float, acceleration: float, tolerance: float = RULES.tolerance
) -> float:
    """Return the least time [s] of all motions about the axis of the turn.

    The body turns towards the goal by theta and any number of whole turns, in either direction. To a
    distance D ahead it takes 2 sqrt(a (D + b) + w^2/2) - w - 2 sqrt(a b) over a, if it can stop before
    D + b; else it stops beyond and comes back.

    Args:
        angle: to the goal [rad].
        rate: towards the goal [rad/s]; below zero it turns away.
        acceleration: bound of |u| [rad/s^2].
        tolerance: half width of the band over the angle.
    """
    band = tolerance * angle
    speed = abs(rate)
    whole = 2.0 * math.pi
    ahead = angle if rate >= 0.0 else whole - angle
    stopping = 0.5 * speed**2 / acceleration
    turns = math.ceil((stopping - band - ahead) / whole)
    # The first place at which it can stop, and the one before, which it passes and returns to.
    first = ahead + whole * max(turns, 0)
    highest = math.sqrt(acceleration * (first + band) + 0.5 * speed**2)
    landing = 2.0 * math.sqrt(acceleration * band)
    onward = (2.0 * highest - speed - landing) / acceleration
    behind = stopping - first + whole
    returning = speed / acceleration + least_time_from_rest(behind, acceleration, band)
    return min(onward, returning)


def least_time_from_rest(angle: float, acceleration: float, band: float) -> float:
    """Return the least time [s] from rest to a band of half width `band` [rad] at an angle [rad]."""
    there = math.sqrt((angle + band) / acceleration)
    return 2.0 * (there - math.sqrt(band / acceleration))


def least_settling_time(
    quat_wxyz: Sequence[float],
    omega: Sequence[float],
    acceleration: float,
    guesses: int = GUESSES,
    seed: int = 0,
) -> float:
    """Return the least settling time [s] that is known; NaN where no guess led to an extremal.

    Args:
        quat_wxyz: the turn from the goal to the body.
        omega: angular velocity [rad/s], base frame.
        acceleration: bound of |u| [rad/s^2].
        guesses: number of drawn guesses.
        seed: of their draw.
    """
    unit_s = 1.0 / math.sqrt(acceleration)
    body = place_body(quat_wxyz, unit_s * np.asarray(omega, dtype=float))
    times = list_closed_forms(body, RULES.tolerance)
    at_rest = find_extremals(body, guesses, seed)
    times += find_arrivals(body, at_rest).times.tolist()
    # Before rest at T the angle is (T - t)^2/2 at most: at T - sqrt(2 b) the body is in for good.
    times += (at_rest.times[:1] - np.sqrt(2.0 * body.band)).tolist()
    return unit_s * min(times, default=math.nan)


def least_time_to_rest(
    quat_wxyz: Sequence[float],
    omega: Sequence[float],
    acceleration: float,
    guesses: int = GUESSES,
    seed: int = 0,
) -> float:
    """Return the least time [s] to rest at the goal that is known; arguments as before."""
    unit_s = 1.0 / math.sqrt(acceleration)
    body = place_body(quat_wxyz, unit_s * np.asarray(omega, dtype=float))
    times = list_closed_forms(body, 0.0)
    times += find_extremals(body, guesses, seed).times.tolist()
    return unit_s * min(times, default=math.nan)


def place_body(quat_wxyz: Sequence[float], omega: Sequence[float] | np.ndarray) -> Bodies:
    """Return one body; omega in units of sqrt(a)."""
    quat = np.asarray(quat_wxyz, dtype=float)[:, np.newaxis]
    quat = quat / np.linalg.norm(quat)
    vector_length = np.linalg.norm(quat[1:], axis=0)
    angle = 2.0 * np.arctan2(vector_length, np.abs(quat[0]))
    band = np.array([RULES.band_rad(angle.item())])
    return Bodies(quat, np.asarray(omega, dtype=float)[:, np.newaxis], band)


def find_angles(bodies: Bodies) -> np.ndarray:
    """Return the angle to the goal of each body [rad]."""
    vector_length = np.linalg.norm(bodies.quat[1:], axis=0)
    return 2.0 * np.arctan2(vector_length, np.abs(bodies.quat[0]))


def list_closed_forms(body: Bodies, tolerance: float) -> list[float]:
    """Return the time [1/sqrt(a)] about the axis of the turn, if the spin of a body is about it."""
    [angle] = find_angles(body)
    vector = body.quat[1:, 0] * np.sign(body.quat[0, 0] or 1.0)
    omega = body.omega[:, 0]
    rate = -float(vector @ omega) / max(math.sin(0.5 * angle), AT_GOAL)
    is_about_axis = abs(np.linalg.norm(omega) - abs(rate)) <= AT_GOAL * (1.0 + abs(rate))
    if angle <= AT_GOAL or not is_about_axis:
        return []
    return [least_time_about_axis(angle, rate, 1.0, tolerance)]


def find_extremals(
    body: Bodies, guesses: int = GUESSES, seed: int = 0, steps: int = STEPS
) -> Extremals:
    """Return the extremals to rest at the goal, from drawn guesses."""
    [angle] = find_angles(body)
    speed = np.linalg.norm(body.omega)
    shortest = float(certain_least_time(angle, float(speed), 1.0, 0.0))
    copies = body.take(np.zeros(guesses, dtype=int))
    drawn = draw_guesses(np.full(guesses, shortest), np.random.default_rng(seed))
    enough = max(steps, math.ceil(STEPS_PER_SPEED * speed))
    unknown, missing = improve(copies, drawn, miss_rest, steps=enough)
    return keep_distinct(unknown[:, missing <= SOLVED])


def find_arrivals(body: Bodies, at_rest: Extremals, steps: int = STEPS) -> Extremals:
    """Return the extremals to the band that lie near the shortest ones to rest.

    To the band takes up to 2 sqrt(b) less than to rest: what takes that much longer to rest is left out. Where the band
    itself is too narrow to be met from there, wider ones lead to it (WIDENINGS).

    Limitations: below about 0.15 rad, and about the very axis, where L passes through zero, some are not found.
    """
    latest = at_rest.times[:1] + LANDING * np.sqrt(body.band)
    unknown = at_rest.unknown[:, at_rest.times <= latest]
    copies = body.take(np.zeros(unknown.shape[1], dtype=int))
    enough = max(steps, math.ceil(STEPS_PER_SPEED * np.linalg.norm(body.omega)))
    arriving, missing = improve(copies, shorten(copies, unknown), miss_band, steps=enough)
    is_open = missing > SOLVED
    unknown[:, ~is_open] = arriving[:, ~is_open]
    narrow = copies.take(is_open)
    led = shorten(narrow, unknown[:, is_open])
    band = narrow.band
    for factor in WIDENINGS:
        if not is_open.any():
            break
        wide = narrow._replace(band=factor * narrow.band)
        # A wider band takes time off, a narrower one puts it on.
        shorter = LANDING * (np.sqrt(wide.band) - np.sqrt(band))
        guesses = shift(led, -shorter)
        arriving, missing_wide = improve(wide, guesses, miss_band, steps=enough)
        led = np.where(missing_wide <= SOLVED, arriving, guesses)
        band = wide.band
        missing[is_open] = missing_wide
    unknown[:, is_open] = led
    return keep_distinct(unknown[:, missing <= SOLVED])


def shorten(bodies: Bodies, unknown: np.ndarray) -> np.ndarray:
    """Return guesses of arrivals in the band: extremals to rest, without their last 2 sqrt(b)."""
    return shift(unknown, -LANDING * np.sqrt(bodies.band))


def shift(unknown: np.ndarray, change: np.ndarray) -> np.ndarray:
    """Return unknowns with other times; of each time LEAST_SHARE is left at least."""
    times = np.exp(unknown[6])
    shifted = np.maximum(times + change, LEAST_SHARE * times)
    return np.vstack([unknown[:6], np.log(shifted)])


def keep_distinct(unknown: np.ndarray) -> Extremals:
    """Return solved unknowns, the shortest time first, and one of those whose times agree."""
    order = np.argsort(unknown[6])
    logarithms = unknown[6, order]
    steps = np.diff(logarithms, prepend=-np.inf)
    kept = order[steps > APART]
    return Extremals(np.exp(unknown[6, kept]), unknown[:, kept])
