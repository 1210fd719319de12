"""A controller as it is shipped, and laws of ours at its gains: stiffness, places where it is stuck, unwinding, times.

Stiffness and directions are of the command at rest; episodes run on the ideal plant with a held command, from both
signs of the quaternion. Where the authors cancel no inertia, unit inertia stands for the body's: of another, I, divide
both gains by it, so that the damping ratio falls as 1/sqrt(I) and I = D^2/(4 K) is critically damped.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from bench.audit import audit
from bench.engines.binding import memory_of
from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.episode import OUTCOME, SETTLING_TICK, start_rows
from bench.engines.episode import numbers as numbers_of
from bench.engines.metrics.registry import metrics_of
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.field import ENGINE, ZERO, CommandField, about, size
from bench.experiments.request import Request
from bench.experiments.suites import BEST, LONG
from bench.law.contender import Contender
from bench.law.contenders.registry import contenders, find_contender
from bench.law.shipped import ANTIPODE, NEAR, VELOCITY, AsShipped
from tasks.base import Start
from tasks.haar import axes
from tasks.rotations import multiply
from tasks.verdict import SETTLED

CONTROLLER_S = 0.7
"""CPU seconds a controller, most of them for the audit and for compiling."""

FELT_RAD = {"stiffness_1mrad": 1e-3, "stiffness_50mrad": 5e-2, "stiffness_1rad": 1.0}
"""Angles at which stiffness is measured: inside any deadband, outside it and under any clip of torques, under clips."""
BENT_DEG = (10, 30, 90, 150)
"""Angles at which the direction of the command is examined."""
SETTLING_DEG = {"1": 1.0, "30": 30.0, "90": 90.0, "150": 150.0, "179": 179.0, "179_9": 179.9}

BASE = np.eye(3)
DIRECTIONS = 200
AXES = np.concatenate((BASE[:1], -BASE[2:], axes(6)))
"""Axes of episodes: two of the base, and some of no kind."""
BEFORE_180_RAD = 1e-6
SETTLING_RAD = {f"settling_{name}_s": math.radians(angle) for name, angle in SETTLING_DEG.items()}
SETTLING_RAD["settling_near_180_s"] = math.pi - BEFORE_180_RAD
"""The columns of settling times -> angles of the starts."""
AWAY_RAD = math.radians(1.0)
"""Tolerance: a spring along the shorter rotation increases the angle of a body at rest by less."""
SAMPLE_S = 0.02
HAVERSINE = NUMBERS.index("haversine")


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit for each controller."""
    return tuple(Unit("shipped", selector=name, count=1, total=1, horizon_s=LONG) for name in contenders("shipped"))


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return the row of the controller, then that of each of BEST at its gains."""
    laws = [law for law in BEST if law.partition("/")[0] in contenders("regulators")]
    return compare(contenders("shipped")[unit.selector], laws, request, unit.horizon_s)


def compare(one: AsShipped, laws: Iterable[str], request: Request, horizon_s: float) -> list[dict]:
    """Return the row of a controller, then those of laws at its gains; no law takes the place of velocity commands."""
    made = [row(one, "", Contender(one.law), request, horizon_s) | {"findings": ", ".join(findings(one))}]
    for law in laws if one.level != VELOCITY else ():
        made.append(row(one, law, find_contender(law), request, horizon_s) | {"findings": ""})
    return made


def row(one: AsShipped, law: str, contender: Contender, request: Request, horizon_s: float) -> dict:
    """Return a law's numbers at the gains of a controller."""
    gains = one.gains
    field = CommandField(contender, gains)
    pulls = {name: np.sum(field(about(BASE, angle)) * -BASE, axis=1) for name, angle in FELT_RAD.items()}
    felt = {name: float(np.min(pulls[name]) / angle) for name, angle in FELT_RAD.items()}  # least over the base's axes
    ratio, is_velocity = math.nan, one.level == VELOCITY
    if not is_velocity and felt["stiffness_50mrad"] > 0.0:
        ratio = gains.kv / (2.0 * math.sqrt(gains.kp * felt["stiffness_50mrad"]))
    dead = size(field(about(axes(DIRECTIONS), math.pi) * (0.0, 1.0, 1.0, 1.0))) <= ZERO
    found = {
        "shipped": one.name,
        "law": law,
        "level": one.level,
        "shapes_inertia": "yes" if one.shapes_inertia else "no",
        "kp": gains.kp,
        "kv": math.nan if is_velocity else gains.kv,
        **felt,
        "damping_ratio": ratio,
        "critical": math.nan if one.shapes_inertia else ratio**2,
        **{f"bent_{angle}_rad": compute_bending(field, math.radians(angle)) for angle in BENT_DEG},
        "half_turns": DIRECTIONS,
        "dead": int(dead.sum()),
    }
    if is_velocity:
        return found | {"starts": 0, "lost": 0, "away": 0} | dict.fromkeys(SETTLING_RAD, math.nan)
    memories = (memory_of(contender),) if law else (NEAR, ANTIPODE)  # of ours, which take matrices, both signs are one
    return found | motion(contender, memories, replace(request, gains=gains), horizon_s)


def compute_bending(field: CommandField, angle: float) -> float:
    """Compute the largest angle between the command at rest and the axis [rad], 0 within ZERO; NaN where all rest."""
    k = axes(DIRECTIONS)
    u = field(about(k, angle))
    moves = size(u) > ZERO
    off = np.arctan2(np.linalg.norm(np.cross(u, -k), axis=1), np.sum(u * -k, axis=1))
    worst = float(off[moves].max()) if moves.any() else math.nan
    return 0.0 if worst < ZERO else worst  # what rounding leaves is no property of a controller


def findings(one: AsShipped) -> tuple[str, ...]:
    """Return the faults and notes of the audit, for the error as a function of two quaternions with slope 1."""

    def error(q: np.ndarray, q_d: np.ndarray) -> tuple[float, float, float]:
        (w, x, y, z), goal = q.tolist(), q_d.tolist()
        return one.error(multiply(tuple(goal), (w, -x, -y, -z)))

    return tuple(found.fault.name for found in audit(error, "wxyz", name=one.name).findings)


def motion(contender: Contender, memories: tuple, request: Request, horizon_s: float) -> dict:
    """Simulate starts at rest from each of the memories, and count how they end."""
    from bench.engines.simulate import by_law

    angles = SETTLING_RAD
    begun = start_rows([Start("", tuple(q)) for angle in angles.values() for q in about(AXES, angle).tolist()])
    metrics, limits, episodes = tuple(metrics_of(on_arm=False)), numbers_of(request.limits(horizon_s)), []
    every = round(SAMPLE_S / request.dt_s)
    for memory in memories:
        curves = blank_curves(len(begun), limits.ticks // every, every)
        made = by_law(ENGINE, contender, begun, limits, metrics, curves, memory)
        farthest = np.nanmax(curves.samples[:, :, HAVERSINE], axis=1)
        allowed = np.sin(0.5 * np.minimum(np.repeat([*angles.values()], len(AXES)) + AWAY_RAD, math.pi)) ** 2
        episodes.append(np.column_stack((made[:, [OUTCOME, SETTLING_TICK]], farthest > allowed)))
    outcome, tick, is_away = np.reshape(episodes, (len(memories), len(angles), len(AXES), 3)).transpose(3, 1, 0, 2)
    settled = outcome == SETTLED
    slowest = np.where(settled, tick, np.nan).max(axis=(1, 2)) * request.dt_s
    return {
        "starts": settled.size,
        "lost": int((~settled).sum()),
        "away": int(is_away.sum()),
        **dict(zip(angles, slowest.tolist(), strict=True)),
    }


EXPERIMENT = Experiment.of(
    globals(),
    "controllers as they are shipped",
    cost_s=lambda unit: CONTROLLER_S,
    compiles=False,
)
