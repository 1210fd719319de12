"""A controller as it is shipped, and laws of ours at its gains: what is felt, where it rests, how long it takes.

Stiffness and directions are of the command at rest; episodes run on the ideal plant with a held command, from both
signs of the quaternion. Where the authors cancel no inertia, unit inertia stands for the body's: of another, I, divide
both gains by it, so that the damping ratio falls as 1/sqrt(I) and I = D^2/(4 K) is critically damped.
"""

import math

import numpy as np
import pandas as pd

from bench.audit import audit
from bench.contenders.registry import find_contender
from bench.engines.binding import memory_of
from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.episode import OUTCOME, SETTLING_TICK, blank, numbers, start_rows
from bench.engines.simulate import by_law
from bench.experiments.experiment import Settings
from bench.experiments.rows.command_field import ENGINE, ZERO, Field, about, size
from bench.law.contender import Contender, Gains
from bench.law.shipped import ANTIPODE, NEAR, VELOCITY, Shipped, regulator_of
from bench.metrics.registry import metrics_of
from bench.tables.schema import TABLES
from bench.tables.shipped_columns import BENT_DEG, FELT_RAD, SETTLING_DEG
from tasks.base import Start
from tasks.rotations import multiply
from tasks.sphere import axes
from tasks.verdict import SETTLED

BASE = np.eye(3)
DIRECTIONS = 200
AXES = np.concatenate((BASE[:1], -BASE[2:], axes(6)))
"""Of episodes: two of the base, and some of no kind."""
BEFORE_180_RAD = 1e-6
AWAY_RAD = math.radians(1.0)
"""By more than this a spring that pulls the short way increases no angle of a body at rest."""
SAMPLE_S = 0.02
HAVERSINE = NUMBERS.index("haversine")


def frame(one: Shipped, laws: tuple[str, ...], settings: Settings, horizon_s: float) -> pd.DataFrame:
    """The rows of a controller."""
    rows = [row(one, "", Contender(regulator_of(one)), settings, horizon_s) | {"findings": ", ".join(findings(one))}]
    if one.level != VELOCITY:
        rows += [row(one, law, find_contender(law), settings, horizon_s) | {"findings": ""} for law in laws]
    return pd.DataFrame(rows, columns=TABLES["shipped"].names)


def row(one: Shipped, law: str, contender: Contender, settings: Settings, horizon_s: float) -> dict:
    """A law's numbers at the gains of a controller."""
    gains = Gains(one.stiffness, one.damping or 0.0)
    field = Field(contender, gains)
    felt = {name: stiffness(field, angle) for name, angle in FELT_RAD.items()}
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
        **{f"bent_{angle}_rad": bent(field, math.radians(angle)) for angle in BENT_DEG},
        "half_turns": DIRECTIONS,
        "dead": int(dead.sum()),
    }
    if is_velocity:
        return found | {"starts": 0, "lost": 0, "away": 0}
    memories = (memory_of(contender),) if law else (NEAR, ANTIPODE)  # of ours, which take matrices, both signs are one
    return found | motion(contender, memories, settings._replace(gains=gains), horizon_s)


def stiffness(field: Field, angle: float) -> float:
    """e . k / theta at rest, the least over the axes of the base."""
    return float(np.min(np.sum(field(about(BASE, angle)) * -BASE, axis=1)) / angle)


def bent(field: Field, angle: float) -> float:
    """The largest angle between the command at rest and the axis [rad], 0 within ZERO; NaN where all rest."""
    k = axes(DIRECTIONS)
    u = field(about(k, angle))
    moves = size(u) > ZERO
    off = np.arctan2(np.linalg.norm(np.cross(u, -k), axis=1), np.sum(u * -k, axis=1))
    worst = float(off[moves].max()) if moves.any() else math.nan
    return 0.0 if worst < ZERO else worst  # what rounding leaves is no property of a controller


def findings(one: Shipped) -> tuple[str, ...]:
    """What the audit says of the error, notes too, as a function of two quaternions whose slope shall be 1."""

    def error(q, q_d):
        (w, x, y, z), goal = q.tolist(), q_d.tolist()
        return one.error(multiply(tuple(goal), (w, -x, -y, -z)))

    return tuple(found.fault.name for found in audit(error, "wxyz", name=one.name).findings)


def motion(contender: Contender, memories: tuple, settings: Settings, horizon_s: float) -> dict:
    """What becomes of starts at rest, from each of the memories."""
    angles = {f"settling_{name}_s": math.radians(angle) for name, angle in SETTLING_DEG.items()}
    angles["settling_near_180_s"] = math.pi - BEFORE_180_RAD
    begun = start_rows([Start("", tuple(q)) for angle in angles.values() for q in about(AXES, angle).tolist()])
    metrics, limits, episodes = tuple(metrics_of(on_arm=False)), numbers(settings.limits(horizon_s)), []
    every = round(SAMPLE_S / settings.dt_s)
    for memory in memories:
        made, curves = blank(len(begun), metrics), blank_curves(len(begun), limits.ticks // every, every)
        by_law(ENGINE, contender, begun, limits, made, metrics, curves, memory)
        farthest = np.nanmax(curves.samples[:, :, HAVERSINE], axis=1)
        allowed = np.sin(0.5 * np.minimum(np.repeat([*angles.values()], len(AXES)) + AWAY_RAD, math.pi)) ** 2
        episodes.append(np.column_stack((made[:, [OUTCOME, SETTLING_TICK]], farthest > allowed)))
    outcome, tick, is_away = np.reshape(episodes, (len(memories), len(angles), len(AXES), 3)).transpose(3, 1, 0, 2)
    settled = outcome == SETTLED
    slowest = np.where(settled, tick, np.nan).max(axis=(1, 2)) * settings.dt_s
    return {
        "starts": settled.size,
        "lost": int((~settled).sum()),
        "away": int(is_away.sum()),
        **dict(zip(angles, slowest.tolist(), strict=True)),
    }
