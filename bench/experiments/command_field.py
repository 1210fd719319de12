"""What a law commands, as a function of state: stiffness and damping, equilibria, jumps, how hard it pulls.

A row is a finding, with the state that shows it. Stiffness and damping are shares of the gains that are set; a command
is |u|/kp. All are also taken at two goals whose matrices are not symmetric: there a wrong frame or order shows.

Limitations: an equilibrium away from 180° rotations, and a jump that no geodesic crosses, are not seen.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from bench.experiments.episodes import prepare
from bench.experiments.exchanged import find_order
from bench.experiments.experiment import OF_LAWS, Experiment, Unit, user_laws_last
from bench.experiments.field import ZERO, CommandField, about, size
from bench.experiments.request import Request
from bench.experiments.traces import laws
from bench.law.contender import Contender
from bench.law.inputs import Gains
from bench.law.so3 import from_quaternion
from tasks.base import IDENTITY, Quat
from tasks.haar import axes
from tasks.rotations import multiply

LAW_S, CALLS = 0.4, 150_000
"""CPU seconds and, at most, calls of a law."""

GOALS = (IDENTITY, (0.8, 0.2, 0.4, 0.4), (0.4, -0.8, 0.4, 0.2))
"""The last two lie off the singular sets of all our coordinates."""

TURN_RAD, RATE = 1e-4, 1e-3
"""Step of central differences: their error is under 1e-8, rounding leaves 1e-12."""

SAME, BOUNDED = 1e-3, 1e3
"""Shares: by the first a stiffness may differ from what it is taken for; above the second it is a jump or a pole."""

AXES, GEODESICS, SAMPLES, HALVINGS, PULLED = 200, 60, 48, 40, np.radians((30.0, 90.0))

EXCHANGED, ODD = "exchanged-", ("unbounded", "uneven", "none")
"""Before the order of a quaternion's components, as a word of a stiffness; and words for which one is looked for."""

LEFT, POLE, BESIDE_RAD = 1e-3, 1e3, 1e-6
"""|u|/kp that is left of a jump when its interval is 1e-13 rad long: no slope under 1e10 is taken for one; from which
on a jump is one to infinity, of which 1e6 is seen: 8 is the most of other laws. How near to a place a jump is at it."""


class FieldFinding(NamedTuple):
    """One row: what was found of what, its size, in how many states of how many, and the state that shows it."""

    finding: str
    what: str
    value: float = math.nan
    least: float = math.nan
    most: float = math.nan
    found: int = 0
    of: int = 0
    quat: np.ndarray | tuple = (math.nan,) * 4
    goal: Quat = IDENTITY
    u: np.ndarray | tuple = (math.nan,) * 3


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit for each law on the free body, a user's last."""
    whole = Unit("command-field", task="free-body", engine="ideal-held", count=1, total=1)
    made = [replace(whole, contender=one.name) for one in laws(request)]
    return user_laws_last(made, request)


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return one row a finding."""
    one = request.contender(unit.contender)
    found: list[dict[str, Any]] = [{**one.words, **each._asdict()} for each in findings(one, request.gains)]
    for row in found:
        for name, stem, parts in (("quat", "quat_", "wxyz"), ("goal", "goal_quat_", "wxyz"), ("u", "u_", "xyz")):
            row |= {stem + part: float(x) for part, x in zip(parts, row.pop(name), strict=True)}
    return found


def findings(one: Contender, gains: Gains) -> Iterator[FieldFinding]:
    """Yield all findings of a law."""
    field = CommandField(one, gains)
    with np.errstate(all="ignore"):
        yield from _near_goal(field)
        yield from _half_turns(field)
        yield from _along_geodesics(field)


def _near_goal(field: CommandField) -> Iterator[FieldFinding]:
    """Look whether the law rests at the goal, and at its stiffness and damping there."""
    base, gains = np.eye(3), field.gains
    at = np.array([field(np.array([goal]), goal)[0] for goal in GOALS])
    worst = int(np.argmax(size(at)))
    largest, goal = size(at)[worst], GOALS[worst]
    what = "rests" if largest <= ZERO else "pushes" if np.isfinite(largest) else "no-number"
    yield FieldFinding("goal", what, largest, quat=goal, goal=goal, u=at[worst] * gains.kp)
    K, D = [], []
    for goal in GOALS:
        sides = ([multiply(tuple(about(axis, sign * TURN_RAD)), goal) for axis in base] for sign in (1.0, -1.0))
        up, down = (field(np.array(side), goal) for side in sides)
        K.append((down - up).T / (2.0 * TURN_RAD))
        beside = np.array([multiply(tuple(about(np.array((0.6, 0.0, 0.8)), TURN_RAD)), goal)] * 3)
        up, down = (field(beside, goal, sign * RATE * base) for sign in (1.0, -1.0))
        D.append((down - up).T * gains.kp / (2.0 * RATE * gains.kv))
    stiffness = _compared("stiffness", np.array(K), field.one.regulator.stiffness)
    is_odd = what == "pushes" or stiffness.what in ODD
    order = find_order(field) if is_odd else ""
    yield stiffness._replace(what=f"{EXCHANGED}{order}") if order else stiffness
    yield _compared("damping", np.array(D), (1.0, 1.0, 1.0))


def _compared(finding: str, matrices: np.ndarray, declared: tuple) -> FieldFinding:
    """Compare the matrices found at GOALS with what they should be, R_d diag(declared) R_d^T."""
    turns = np.array([from_quaternion(goal) for goal in GOALS]).transpose(0, 2, 1)
    wanted = turns @ np.diag(declared) @ turns.transpose(0, 2, 1)
    off = np.nan_to_num(np.abs(matrices - wanted).max(axis=(1, 2)), nan=np.inf)
    worst = int(np.argmax(off))
    most, _, least = np.linalg.svd(np.nan_to_num(matrices[worst], posinf=0.0, neginf=0.0), compute_uv=False)
    shown = {"least": least, "most": most, "goal": GOALS[worst]}
    if off[worst] > BOUNDED:
        return FieldFinding(finding, "unbounded", **shown)
    if np.abs(matrices).max() < SAME:
        return FieldFinding(finding, "none", 0.0, **shown)
    for word, turned in {"": np.eye(3), "body-frame": turns.transpose(0, 2, 1), "turned-by-goal": turns}.items():
        expected = turned @ wanted
        share = float(np.sum(expected * matrices) / np.sum(expected * expected))
        if np.abs(matrices - share * expected).max() >= SAME * abs(share):
            continue
        if word:  # at I all frames are one
            called = "row-first" if word == "body-frame" and share < 0.0 else word
            return FieldFinding(finding, called, share, **shown | {"goal": GOALS[-1]})
        near = (known for known, of in {"as-set": 1.0, "half": 0.5}.items() if abs(share - of) < 0.01)
        return FieldFinding(
            finding, next(near, "scaled" if share > 0.0 else "wrong-sign"), share, **shown
        )
    return FieldFinding(finding, "uneven" if off[0] > SAME else "uneven-elsewhere", **shown)


def _half_turns(field: CommandField) -> Iterator[FieldFinding]:
    """Look for rotations of 180° with no command, or no number, about axes of small whole numbers and spread ones."""
    whole = [v for v in itertools.product(range(-3, 4), repeat=3) if v > (0, 0, 0) and math.gcd(*v) == 1]
    k = np.concatenate((np.array(whole) / np.linalg.norm(whole, axis=1)[:, None], axes(AXES - len(whole))))
    quats = about(k, math.pi) * (0.0, 1.0, 1.0, 1.0)
    sizes = size(field(quats))
    for finding, is_one in (("dead-half-turns", sizes <= ZERO), ("no-number-half-turns", ~np.isfinite(sizes))):
        yield _largest(field, finding, _set_of(k, is_one), sizes, is_one, quats)


def _largest(
    field: CommandField,
    name: str,
    what: str,
    sizes: np.ndarray,
    is_one: np.ndarray,
    quats: np.ndarray,
) -> FieldFinding:
    """Return the finding of some states; the one where its size is largest shows it."""
    if not is_one.any():
        return FieldFinding(name, "none", of=len(quats))
    worst = int(np.argmax(np.where(is_one, sizes, -np.inf)))
    shown = {"quat": quats[worst], "u": field(quats[[worst]])[0] * field.gains.kp}
    return FieldFinding(name, what, sizes[worst], found=int(is_one.sum()), of=len(quats), **shown)


def _set_of(directions: np.ndarray, is_one: np.ndarray) -> str:
    """Return the word for the set that these axes form."""
    if is_one.all() or not is_one.any():
        return "every"
    normal = np.linalg.svd(directions[is_one])[2][-1]
    if is_one.sum() > 3 and (is_one == (np.abs(directions @ normal) < ZERO)).all():
        axis = int(np.argmax(np.abs(normal)))
        return "plane-" + "xyz"[axis] if abs(normal[axis]) > 1.0 - ZERO else "plane"
    return "some"


def _along_geodesics(field: CommandField) -> Iterator[FieldFinding]:
    """Look along closed geodesics through the goal where it pulls away and jumps, and how hard it pulls at PULLED."""
    k, step = axes(GEODESICS), 2.0 * math.pi / SAMPLES
    axis, low = np.repeat(k, SAMPLES, axis=0), np.tile((np.arange(SAMPLES) + 0.5) * step, GEODESICS)
    high = low + step
    at_low, at_high = field(about(axis, low)), field(about(axis, high))
    pull = np.nan_to_num(np.sum(at_low * axis, axis=1) * np.where(low < math.pi, -1.0, 1.0))
    yield _largest(field, "away", "some", -pull, pull < -ZERO, about(axis, low))
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        at = field(about(axis, middle))
        first = size(at - at_low) >= size(at_high - at)
        low, high = np.where(first, low, middle), np.where(first, middle, high)
        at_low, at_high = np.where(first[:, None], at_low, at), np.where(first[:, None], at, at_high)
    angle = np.remainder(low, 2.0 * math.pi)
    before, behind = (field(about(axis, angle + sign * BESIDE_RAD)) for sign in (-1.0, 1.0))
    change = size(at_high - at_low)
    change = np.where(np.isfinite(change), change, size(behind - before))  # no number right there
    from_goal = np.minimum(angle, 2.0 * math.pi - angle)
    places = {"goal": from_goal < BESIDE_RAD, "half-turns": from_goal > math.pi - BESIDE_RAD}
    places["elsewhere"] = ~(places["goal"] | places["half-turns"])
    for place, is_there in places.items():
        there = np.where(is_there, change, 0.0).reshape(GEODESICS, SAMPLES)
        at, sizes = there.argmax(axis=1) + SAMPLES * np.arange(GEODESICS), there.max(axis=1)
        what = "unbounded" if sizes.max() > POLE else "jump"
        yield _largest(field, f"jump-{place}", what, sizes, sizes > LEFT, about(axis[at], angle[at]))
    pulls = np.array([np.sum(field(about(k, angle)) * -k, axis=1) for angle in PULLED])
    # theta is 2 atan2(|eps|, eta), or atan2(sin, cos): with exchanged arguments it is one of these less theta
    is_swapped = any(np.abs(pulls - (wrong - PULLED)[:, None]).max() < 0.01 for wrong in (math.pi, 0.5 * math.pi))
    yield FieldFinding(
        "pull",
        "swapped" if is_swapped else "some",
        pulls[-1].mean(),
        pulls[-1].min(),
        pulls[-1].max(),
    )


FINDINGS = (
    *("goal", "stiffness", "damping", "dead-half-turns", "no-number-half-turns", "away"),
    *("jump-goal", "jump-half-turns", "jump-elsewhere", "pull"),
)
"""Every law has a row of each, in this order."""


EXPERIMENT = Experiment.of(
    globals(),
    "commands over all states",
    prepare=prepare,
    cost_s=lambda unit: LAW_S,
    takes=OF_LAWS,
    is_whole=lambda request, unit, rows: tuple(rows["finding"]) == FINDINGS,
    ticks=lambda request, unit: CALLS,
)
