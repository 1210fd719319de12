"""Episodes on the free body from starts of the claims' own: small turns, near goals, spins beside a pole, wrong models.

Every episode is on the continuous plant (`ideal-rk4`), but those of a perturbation, which steps as the judge does.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from bench.base.on_first_use import Turn, pd
from bench.experiments.episodes import prepare_law, rows_from
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.probe_values.turns import (
    BESIDE,
    DIRECTIONS,
    FEEDBACK,
    GAINS,
    MARGINS_RAD,
    MATRIX,
    NEAR_GOAL_RAD,
    PERTURBED,
    SPEED,
)
from bench.experiments.probes.number import Number
from bench.experiments.request import Request
from bench.experiments.suites import SHORT
from bench.law.contenders.registry import representation
from bench.law.inputs import Gains
from tasks.base import IDENTITY, Start
from tasks.haar import axes

LINEARIZED = "linearized-euler/zyx-euler"

SMALL_RAD = (0.1, 0.01, 0.001)
LARGER_RAD = (0.2, 0.4, 0.6, 0.8, 1.0, 1.2)
ALONE_RAD = (0.7, 1.0, 1.4)
"""rad of one angle alone: beta stays under pi/2."""

ABOUT = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 1.0, 1.0))
"""Axes of the small turns of the rotation-matrix law."""

LONG_S = 20.0
"""Horizon of turns [s]: the slowest pair of GAINS settles in 2.2 s."""

OUTSIDE_RAD = 1e-3
"""How far outside the margin they start."""

PERTURBED_S = 5.0


def about(axis: Sequence[float] | np.ndarray, angle: float) -> tuple:
    """Return the quaternion of a rotation."""
    unit = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    return (math.cos(angle / 2), *(math.sin(angle / 2) * unit).tolist())


def episodes(
    contender: str,
    starts: list[Start],
    gains: Gains,
    dt_s: float,
    horizon_s: float,
) -> pd.DataFrame:
    """Return rows of episodes.parquet of a few starts on the continuous plant."""
    unit = Unit(
        "free-body",
        contender,
        "free-body",
        engine="ideal-rk4",
        count=len(starts),
        horizon_s=horizon_s,
    )
    return rows_from(Request(gains=gains, dt_s=dt_s), unit, starts)


def numbers_of(
    rows: pd.DataFrame, at: float, words: dict, measures: Sequence[str]
) -> Iterator[Number]:
    """Yield some columns of episodes as numbers."""
    for row in rows.to_dict("records"):
        gains = Gains(row["kp"], row["kv"])
        for measure in measures:
            yield Number(
                measure,
                row[measure],
                row["start_id"],
                at,
                row["outcome"],
                words,
                gains,
            )


def measure_turns(
    request: Request,
    contender: str,
    directions: Any,
    gains: Gains,
    angle: float,
) -> Iterator[Number]:
    """Yield the settling time from rest after a rotation about each axis."""
    starts = [
        Start(f"axis-{i:02d}", about(axis, angle))
        for i, axis in enumerate(directions)
    ]
    rows = episodes(contender, starts, gains, request.dt_s, LONG_S)
    words = request.contender(contender).words
    yield from numbers_of(rows, angle, words, ("settling_time_s",))


def measure_small_turns(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield settling times of small turns at several gains; at: the angle [rad]."""
    for law, directions in (
        (MATRIX, ABOUT),
        (LINEARIZED, axes(DIRECTIONS)),
    ):
        for gains in GAINS:
            for angle in SMALL_RAD:
                yield from measure_turns(
                    request, law, directions, Gains(*gains), angle
                )


def measure_larger_turns(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield settling times of larger turns at the run's gains; at: the angle [rad]."""
    for angle in LARGER_RAD:
        yield from measure_turns(
            request, LINEARIZED, axes(DIRECTIONS), request.gains, angle
        )


def measure_one_angle(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield settling times of turns of one Euler angle alone; at: the angle [rad]."""
    for angle in ALONE_RAD:
        yield from measure_turns(
            request, LINEARIZED, np.eye(3), request.gains, angle
        )


def measure_near_goals(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield settling times from zero rotation to near goals; at: their angle [rad]."""
    starts = []
    for i, axis in enumerate(axes(DIRECTIONS)):
        starts.append(
            Start(
                f"goal-{i:02d}",
                IDENTITY,
                goal_wxyz=about(axis, NEAR_GOAL_RAD),
            )
        )
    rows = episodes(
        LINEARIZED, starts, request.gains, request.dt_s, SHORT
    )
    words = request.contender(LINEARIZED).words
    yield from numbers_of(rows, NEAR_GOAL_RAD, words, ("settling_time_s",))


def starts_beside_pole(margin: float) -> list[Start]:
    """Return bodies that spin in directions all over the sphere, just outside a margin."""
    zyx = representation("zyx-euler")
    starts = []
    for i, direction in enumerate(axes(BESIDE)):
        turns = [
            math.remainder(turn * (i + 0.5), 2 * math.pi) / 2
            for turn in (2.4, 3.7)
        ]
        beta = (-1) ** i * (math.pi / 2 - margin - OUTSIDE_RAD)
        R = zyx.to_matrix((turns[0], beta, turns[1]))
        quat = Turn.from_matrix(np.array(R).T).as_quat(scalar_first=True)
        omega = tuple((SPEED * direction).tolist())
        starts.append(Start(f"spin-{i:02d}", tuple(quat.tolist()), omega))
    return starts


def measure_beside_poles(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield the largest commands of spins beside a pole; at: the margin [rad]."""
    words = request.contender(FEEDBACK).words
    for margin in MARGINS_RAD:
        starts = starts_beside_pole(margin)
        rows = episodes(
            FEEDBACK, starts, request.gains, request.dt_s, SHORT
        )
        yield from numbers_of(rows, margin, words, ("peak_u",))


def measure_perturbed(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield what a perturbation does to two laws from the same starts; at: its level."""
    axis, count, laws, measures = PERTURBED[unit.selector]
    for law in laws:
        own = Unit(
            "robustness",
            law,
            selector=axis,
            count=count,
            total=count,
            horizon_s=PERTURBED_S,
        )
        rows = rows_of(request, own)
        words = request.contender(law).words
        for level, at_level in rows.groupby("level", sort=False):
            yield from numbers_of(at_level, level, words, measures)


def prepare(request: Request, unit: Unit) -> None:
    """Compile the loop of the free body and a law of it."""
    from bench.engines.metrics.registry import metrics_of

    prepare_law(
        request,
        Unit("free-body", MATRIX),
        "ideal-rk4",
        tuple(metrics_of(on_arm=False)),
    )
