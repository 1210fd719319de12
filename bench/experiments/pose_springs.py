"""Springs of a pose: work over closed paths, the path of the hand's origin, and the effect of drawing it elsewhere.

A closed path has phi and p, each a cos s + b sin s + c sin 2s, with the twist in the tool's axes in closed form: omega
= J_r(phi) phi', v = R^T p'. Motions are those of velocity commands at unit gains, twist = wrench with K = I, kr = 1.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from bench.base.on_first_use import Turn
from bench.experiments.columns import read_table
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.experiments.springs import LOOPS, POINTS, WIDTH, closed_path, draw_stiffness, right_jacobian
from bench.law.contenders.registry import contenders

if TYPE_CHECKING:
    from bench.law.kinds import Spring

NAME = "pose-springs"

TURNING = 10.0
"""kr [N m/rad]; the eigenvalues of K are STIFFNESSES [N/m], along drawn axes."""
STARTS, REACH_M, ELSEWHERE_M = 8, 0.5, 0.2
"""Uniform orientations; distance from the goal; how far off the hand's origin is drawn."""
STEP, STEPS = 0.1, 80
"""Step and end of Runge and Kutta's method, in units of 1/gain: e^-8 of the pose is left."""
ALIKE = np.eye(3)

SPRINGS = tuple(spring for spring in contenders("springs").values() if not spring.is_rotational)


def units(asked: Asked) -> tuple[Unit, ...]:
    """Return one unit."""
    return (Unit(NAME, count=len(SPRINGS), total=len(SPRINGS), horizon_s=2.0),)


def rows(settings: Settings, unit: Unit) -> list[dict]:
    """Return a row a spring."""
    rng = np.random.default_rng((settings.seed, 12))
    K, _ = draw_stiffness(rng)
    paths = rng.uniform(-WIDTH, WIDTH, (LOOPS, 2, 3, 3)) / math.sqrt(3.0)
    begun = list(zip(Turn.random(STARTS, rng=rng), _on_sphere(rng, STARTS, REACH_M), strict=True))
    off = _on_sphere(rng, 1, ELSEWHERE_M)[0]
    found = []
    for spring in SPRINGS:
        lengths = [length(motion(spring, *one)[1]) / REACH_M for one in begun]
        found.append(
            {
                "spring": spring.name,
                "potential": "yes" if spring.potential else "no",
                "work_share": compute_work(spring, paths, K),
                "work_share_isotropic": compute_work(spring, paths, TURNING * ALIKE),
                "starts": STARTS,
                "way_median": float(np.median(lengths)),
                "way_most": max(lengths),
                "apart_m": max(apart(spring, *one, off) for one in begun),
            }
        )
    return found


def _on_sphere(rng: np.random.Generator, count: int, radius: float) -> np.ndarray:
    drawn = rng.normal(size=(count, 3))
    return radius * drawn / np.linalg.norm(drawn, axis=1, keepdims=True)


def wrench(spring: Spring, turn: Turn, p: np.ndarray, K: np.ndarray, kr: float) -> tuple[np.ndarray, ...]:
    """Return (f, m) at a pose."""
    q = tuple(turn.as_quat(canonical=True, scalar_first=True).tolist())
    f, m = spring.wrench(q, tuple(p.tolist()), tuple(map(tuple, K.tolist())), kr)
    return np.array(f), np.array(m)


def compute_work(spring: Spring, paths: np.ndarray, K: np.ndarray) -> float:
    """Compute the largest |work| over closed paths, over what K's greatest stiffness and kr store at the furthest."""
    s = np.linspace(0.0, 2.0 * math.pi, POINTS, endpoint=False)
    stiffest = float(np.linalg.eigvalsh(K).max())
    shares = []
    for path in paths:
        (phi, phi_rate), (p, p_rate) = (closed_path(parts, s) for parts in path)
        power = []
        for each in range(POINTS):
            turn = Turn.from_rotvec(phi[each])
            f, m = wrench(spring, turn, p[each], K, TURNING)
            power.append(f @ turn.inv().apply(p_rate[each]) + m @ right_jacobian(phi[each]) @ phi_rate[each])
        stored = 0.5 * stiffest * np.max(np.sum(p * p, axis=1)) + 0.5 * TURNING * np.max(np.sum(phi * phi, axis=1))
        shares.append(abs(math.fsum(power)) * 2.0 * math.pi / POINTS / stored)
    return float(max(shares))


def motion(spring: Spring, turn: Turn, p: np.ndarray) -> tuple[list[Turn], np.ndarray]:
    """Compute orientations and places of the hand's origin under the velocity command with K = I and kr = 1."""
    turns, places = [turn], [p]

    def rate(turn: Turn, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        v, omega = wrench(spring, turn, p, ALIKE, 1.0)
        return turn.apply(v), turn.apply(omega)

    for _ in range(STEPS):
        v1, w1 = rate(turn, p)
        v2, w2 = rate(Turn.from_rotvec(0.5 * STEP * w1) * turn, p + 0.5 * STEP * v1)
        v3, w3 = rate(Turn.from_rotvec(0.5 * STEP * w2) * turn, p + 0.5 * STEP * v2)
        v4, w4 = rate(Turn.from_rotvec(STEP * w3) * turn, p + STEP * v3)
        p = p + STEP / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4)
        turn = Turn.from_rotvec(STEP / 6.0 * (w1 + 2.0 * w2 + 2.0 * w3 + w4)) * turn
        turns.append(turn)
        places.append(p)
    return turns, np.array(places)


def length(places: np.ndarray) -> float:
    """Return the length of the path through these places [m]."""
    return float(np.sum(np.linalg.norm(np.diff(places, axis=0), axis=1)))


def apart(spring: Spring, turn: Turn, p: np.ndarray, off: np.ndarray) -> float:
    """Compute how far apart the same point of the hand is at most when its origin is drawn `off` beside it [m].

    Hand and goal have the origin at a point c = off of their axes: seen from the goal it lies at p + R c - c.
    """
    turns, places = motion(spring, turn, p)
    _, moved = motion(spring, turn, p + turn.apply(off) - off)
    first = places + np.array([one.apply(off) for one in turns]) - off
    return float(np.max(np.linalg.norm(first - moved, axis=1)))


EXPERIMENT = Experiment(
    NAME,
    "springs of position and orientation",
    read_table(__file__, NAME),
    units,
    rows,
    cost_s=lambda unit: 3.0,
    compiles=False,
)
