"""Rows of springs of a pose: work over closed ways, the way of the hand's origin, and what drawing it elsewhere does.

A closed way has phi and p, each a cos s + b sin s + c sin 2s, with the twist in the tool's axes in closed form: omega =
J_r(phi) phi', v = R^T p'. Motions are those of velocity commands at unit gains, twist = wrench with K = I, kr = 1.
"""

import math

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation

from bench.contenders.registry import known_pose_springs
from bench.experiments.rows.springs import LOOPS, POINTS, WIDTH, right_jacobian
from bench.law.pose_spring import PoseSpring
from bench.tables.schema import TABLES

STIFFNESSES, TURNING = (30.0, 10.0, 3.0), 10.0
"""Eigenvalues of K [N/m], along drawn axes; kr [N m/rad]."""
STARTS, REACH_M, ELSEWHERE_M = 8, 0.5, 0.2
"""Uniform orientations; distance from the goal; how far off the hand's origin is drawn anew."""
STEP, STEPS = 0.1, 80
"""Of Runge and Kutta's method, in units of 1/gain: e^-8 of the pose is left."""
ALIKE = np.eye(3)


def frame(seed: int) -> pd.DataFrame:
    """A row a spring."""
    rng = np.random.default_rng((seed, 12))
    axes = Rotation.random(rng=rng).as_matrix()
    K = axes @ np.diag(STIFFNESSES) @ axes.T
    ways = rng.uniform(-WIDTH, WIDTH, (LOOPS, 2, 3, 3)) / math.sqrt(3.0)
    begun = list(zip(Rotation.random(STARTS, rng=rng), _on_sphere(rng, STARTS, REACH_M), strict=True))
    off = _on_sphere(rng, 1, ELSEWHERE_M)[0]
    rows = []
    for spring in known_pose_springs().values():
        lengths = [length(motion(spring, *one)[1]) / REACH_M for one in begun]
        rows.append(
            {
                "spring": spring.name,
                "potential": "yes" if spring.potential else "no",
                "work_share": work(spring, ways, K),
                "work_share_isotropic": work(spring, ways, TURNING * ALIKE),
                "starts": STARTS,
                "way_median": float(np.median(lengths)),
                "way_most": max(lengths),
                "apart_m": max(apart(spring, *one, off) for one in begun),
            }
        )
    return pd.DataFrame(rows, columns=TABLES["pose-springs"].names)


def _on_sphere(rng: np.random.Generator, count: int, radius: float) -> np.ndarray:
    drawn = rng.normal(size=(count, 3))
    return radius * drawn / np.linalg.norm(drawn, axis=1, keepdims=True)


def wrench(spring: PoseSpring, turn: Rotation, p: np.ndarray, K: np.ndarray, kr: float) -> tuple[np.ndarray, ...]:
    """(f, m) at a pose."""
    q = tuple(turn.as_quat(canonical=True, scalar_first=True).tolist())
    f, m = spring.wrench(q, tuple(p.tolist()), tuple(map(tuple, K.tolist())), kr)
    return np.array(f), np.array(m)


def work(spring: PoseSpring, ways: np.ndarray, K: np.ndarray) -> float:
    """Largest |work| over the closed ways, over what K's greatest stiffness and kr store where each is furthest."""
    s = np.linspace(0.0, 2.0 * math.pi, POINTS, endpoint=False)
    stiffest = float(np.linalg.eigvalsh(K).max())
    shares = []
    for way in ways:
        (phi, phi_rate), (p, p_rate) = (_closed(parts, s) for parts in way)
        power = []
        for each in range(POINTS):
            turn = Rotation.from_rotvec(phi[each])
            f, m = wrench(spring, turn, p[each], K, TURNING)
            power.append(f @ turn.inv().apply(p_rate[each]) + m @ right_jacobian(phi[each]) @ phi_rate[each])
        stored = 0.5 * stiffest * np.max(np.sum(p * p, axis=1)) + 0.5 * TURNING * np.max(np.sum(phi * phi, axis=1))
        shares.append(abs(math.fsum(power)) * 2.0 * math.pi / POINTS / stored)
    return float(max(shares))


def _closed(parts: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A closed way and its rate by s."""
    a, b, c = parts
    way = np.outer(np.cos(s), a) + np.outer(np.sin(s), b) + np.outer(np.sin(2.0 * s), c)
    return way, -np.outer(np.sin(s), a) + np.outer(np.cos(s), b) + 2.0 * np.outer(np.cos(2.0 * s), c)


def motion(spring: PoseSpring, turn: Rotation, p: np.ndarray) -> tuple[list[Rotation], np.ndarray]:
    """Orientations and places of the hand's origin, step by step, of the velocity command with K = I and kr = 1."""
    turns, places = [turn], [p]

    def rate(turn: Rotation, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        v, omega = wrench(spring, turn, p, ALIKE, 1.0)
        return turn.apply(v), turn.apply(omega)

    for _ in range(STEPS):
        v1, w1 = rate(turn, p)
        v2, w2 = rate(Rotation.from_rotvec(0.5 * STEP * w1) * turn, p + 0.5 * STEP * v1)
        v3, w3 = rate(Rotation.from_rotvec(0.5 * STEP * w2) * turn, p + 0.5 * STEP * v2)
        v4, w4 = rate(Rotation.from_rotvec(STEP * w3) * turn, p + STEP * v3)
        p = p + STEP / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4)
        turn = Rotation.from_rotvec(STEP / 6.0 * (w1 + 2.0 * w2 + 2.0 * w3 + w4)) * turn
        turns.append(turn)
        places.append(p)
    return turns, np.array(places)


def length(places: np.ndarray) -> float:
    """Of the way through these places [m]."""
    return float(np.sum(np.linalg.norm(np.diff(places, axis=0), axis=1)))


def apart(spring: PoseSpring, turn: Rotation, p: np.ndarray, off: np.ndarray) -> float:
    """How far apart the same point of the hand is at most, when the hand's origin is drawn `off` beside it [m].

    Hand and goal have the origin at a point c = off of their axes: seen from the goal it lies at p + R c - c.
    """
    turns, places = motion(spring, turn, p)
    _, moved = motion(spring, turn, p + turn.apply(off) - off)
    first = places + np.array([one.apply(off) for one in turns]) - off
    return float(np.max(np.linalg.norm(first - moved, axis=1)))
