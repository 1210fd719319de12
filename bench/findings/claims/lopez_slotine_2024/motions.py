"""Episodes that two claims of Lopez and Slotine compute: the law in both frames, and smaller noise at 180°."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

import tasks
from bench.engines.episode import Settings as Limits
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate_bodies import run_disturbed
from bench.experiments.episode_rows import episode_columns
from bench.experiments.experiment import Settings
from bench.experiments.sliding_motion import AXES, STARTS_OF_A_SET, follow, turn_about
from bench.findings.claims.lopez_slotine_2024.body_frame import IN_BODY_FRAME
from bench.law.contenders.registry import find_contender
from bench.law.contenders.regulators import sliding
from bench.law.inputs import Gains
from tasks.condition import Condition

LAW, WITH_MEMORY = "sliding", "sliding-memory"


class Frames(NamedTuple):
    """The law in the base frame and in the body frame, from the same starts: greatest differences at one time [rad].

    Attributes:
        angle_gap: Of the two angles to the goal.
        apart_at_rest: Angle between the two orientations, of starts at rest.
        apart_spinning: The same of spinning starts.
    """

    angle_gap: float
    apart_at_rest: float
    apart_spinning: float


class Hold(NamedTuple):
    """Episodes from exact 180° rotations with worst-case noise, at several control periods.

    Attributes:
        starts: Number of episodes of each law.
        held: Episodes of the law without memory that do not settle.
        held_with_memory: The same with memory.
        least_rad: Least noise [rad].
    """

    starts: int
    held: int
    held_with_memory: int
    least_rad: float


def compare_frames(gains: Gains, seed: int) -> Frames:
    """Simulate the law in both frames from the same starts, at rest and spinning."""
    gaps, apart = [], []
    for name in ("uniform", "tumbling"):
        starts = tasks.start_set(name, STARTS_OF_A_SET, seed)
        base, body = (follow(law, starts, gains) for law in (sliding.REGULATOR, IN_BODY_FRAME))
        gaps.append(float(np.nanmax(np.abs(base.angle - body.angle))))
        # The chord |R_1 - R_2| = sqrt(8) sin(angle/2) keeps its digits where the trace loses them.
        chord = np.nanmax(np.linalg.norm(base.R - body.R, axis=2)) / math.sqrt(8.0)
        apart.append(2.0 * math.asin(min(1.0, chord)))
    return Frames(max(gaps), *apart)


def hold_by_noise(gains: Gains, periods_s: Sequence[float], share: float) -> Hold:
    """Simulate exact 180° rotations for 2 s with a noise of share Kp period^2, without memory and with it.

    In one control period the command 2 Kp turns a body at rest by Kp period^2: a smaller noise cannot turn it back.
    """
    starts = [turn_about(axis, math.pi) for axis in AXES]
    limits = Limits(gains, 1e-6, 2_000_000, 1)
    metrics = metrics_of(on_arm=False)
    held = dict.fromkeys((LAW, WITH_MEMORY), 0)
    for period_s in periods_s:
        condition = Condition(worst_attitude_error=share * gains.kp * period_s**2, period_s=period_s)
        for law in held:
            numbers = run_disturbed(find_contender(law), starts, condition, limits, metrics)
            rows = episode_columns(Settings(gains=gains), starts, numbers, period_s, 2.0)
            held[law] += sum(outcome != "settled" for outcome in rows["outcome"])
    least_rad = share * gains.kp * min(periods_s) ** 2
    return Hold(len(starts) * len(periods_s), held[LAW], held[WITH_MEMORY], least_rad)
