"""A law along closed geodesics through its goal: where it jumps, where it pulls away, how hard it pulls."""

import math
from collections.abc import Iterator

import numpy as np

from bench.experiments.rows.command_field.field import NOUGHT, SAME, Field, Finding, about, size
from bench.law.contender import AT_REST, Goal
from bench.law.so3 import from_quaternion
from tasks.sphere import axes

GEODESICS, SAMPLES, HALVINGS = 60, 48, 40

LEFT = 1e-3
"""|u|/kp that is left of a jump when its interval is 1e-13 rad long: no slope under 1e10 is taken for one."""

POLE, BESIDE_RAD, PLACE_RAD = 1e3, 1e-6, 1e-6
"""|u|/kp from which on a jump is one to infinity, where the command of a pole is 1e6: 8 is the most of other laws."""

PULLED_DEG = (30, 90, 150)

CARRIED = 6
UNWINDS_RAD = math.radians(170.0)
"""Beyond half a turn: so far no hysteresis reaches, and a law that still pulls back has no other side."""


def along_geodesics(field: Field) -> Iterator[Finding]:
    """Jumps at the goal, at half turns and elsewhere; where it pulls away at rest; pulls at PULLED_DEG."""
    k, memory = axes(GEODESICS), field.one.regulator.memory
    axis = np.repeat(k, SAMPLES, axis=0)
    low = np.tile((np.arange(SAMPLES) + 0.5) * 2.0 * math.pi / SAMPLES, GEODESICS)
    u, home = field(about(axis, low)), np.where(low < math.pi, -1.0, 1.0)[:, None] * axis
    pull = np.where(np.isfinite(size(u)), np.sum(u * home, axis=1), np.nan)
    found = int(np.sum(pull < -NOUGHT))
    worst = int(np.argmin(np.nan_to_num(pull, nan=np.inf)))
    told = {"quat": about(axis, low)[worst], "u": u[worst] * field.gains.kp, "most": -pull[worst]} if found else {}
    whole = "everywhere" if memory is None else "the-long-way"
    what = whole if found == len(pull) else "some" if found else "none"
    yield Finding("away", what, found=found, of=len(pull), **told)
    yield from _jumps(field, axis, low)
    theta = np.radians(PULLED_DEG)
    pulls = np.array([np.sum(field(about(k, angle)) * -k, axis=1) for angle in theta])
    # theta is 2 atan2(|eps|, eta), or atan2(sin, cos): with exchanged arguments it is one of these less theta
    swapped = any(np.abs(pulls - (wrong - theta)[:, None]).max() < 0.01 for wrong in (math.pi, 0.5 * math.pi))
    for degrees, pull in zip(PULLED_DEG, pulls, strict=True):
        least, most = np.min(pull), np.max(pull)
        what = "swapped" if swapped else "even" if most - least < SAME else "uneven"
        yield Finding(f"pull-{degrees}", what, float(np.mean(pull)), least, most)
    yield _carried(field) if memory is not None else Finding("carried", "no-memory")


def _jumps(field: Field, axis: np.ndarray, low: np.ndarray) -> Iterator[Finding]:
    """Each interval's half with the larger change, HALVINGS times: what is left there."""
    high = low + 2.0 * math.pi / SAMPLES
    at_low, at_high = field(about(axis, low)), field(about(axis, high))
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        at = field(about(axis, middle))
        first = size(at - at_low) >= size(at_high - at)
        low, high = np.where(first, low, middle), np.where(first, middle, high)
        at_low, at_high = np.where(first[:, None], at_low, at), np.where(first[:, None], at, at_high)
    change, angle = size(at_high - at_low), np.remainder(low, 2.0 * math.pi)
    from_goal = np.minimum(angle, 2.0 * math.pi - angle)
    places = {"goal": from_goal < PLACE_RAD, "half-turns": from_goal > math.pi - PLACE_RAD}
    places["elsewhere"] = ~(places["goal"] | places["half-turns"])
    for place, is_there in places.items():
        found = np.flatnonzero(is_there & (change > LEFT))
        if not len(found):
            yield Finding(f"jump-{place}", "none", of=GEODESICS)
            continue
        worst = found[[int(np.argmax(change[found]))]]
        quat, largest = about(axis[worst], angle[worst]), change[worst][0]
        if not np.isfinite(largest):  # no number right there
            beside = [field(about(axis[worst], angle[worst] + sign * BESIDE_RAD)) for sign in (-1.0, 1.0)]
            largest = size(beside[1] - beside[0])[0]
        what, crossed = "unbounded" if largest > POLE else "jump", len(set((found // SAMPLES).tolist()))
        u = field(quat)[0] * field.gains.kp
        yield Finding(f"jump-{place}", what, largest, found=crossed, of=GEODESICS, quat=quat[0], u=u)


def _carried(field: Field) -> Finding:
    """How far beyond half a turn a law with memory, turned away from its goal, still pulls the way it came."""
    law, memory0 = field.law
    angles, kept = np.radians(np.arange(1.0, 360.0)), []
    for k in axes(CARRIED):
        memory, turned = memory0, math.nan
        for angle, quat in zip(angles, about(np.tile(k, (len(angles), 1)), angles), strict=True):
            u, memory, _ = law(from_quaternion(tuple(quat)), AT_REST, Goal(), field.gains, memory)
            turned = angle if np.dot(u, k) < 0.0 else turned
        kept.append(turned - math.pi)
    if not np.isfinite(kept).all():
        return Finding("carried", "never-back")
    return Finding("carried", "unwinds" if max(kept) > UNWINDS_RAD else "turns-back", max(kept))
