"""Goals that arrive as a stream (tasks/goal_stream.py): what each filter makes of the goal, and each loop of that.

The laws are those of STREAMED, and for streams of quaternions also the spring on the quaternion as it came.
"""

from __future__ import annotations

import numpy as np

from bench.experiments.experiment import Experiment, Unit
from bench.experiments.request import Request
from bench.experiments.suites import STREAMED
from bench.law.contenders.registry import contenders, find_contender
from tasks.goal_stream import LENGTH_S, STREAMS, goals, true_goal
from tasks.truth import angle

SIGNED = "quaternion,"
"""Streams that arrive so are also run by the spring on the quaternion as it came."""


def units(request: Request) -> tuple[Unit, ...]:
    """Return one unit."""
    return (Unit("goal-streams", count=len(STREAMS), total=len(STREAMS), horizon_s=LENGTH_S),)


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return a row a stream and law; `law` is empty for the spring on the quaternion as it came."""
    from bench.engines.simulate_bodies import run_stream

    dt, laws = request.dt_s, [law for law in STREAMED if law in contenders("regulators")]
    truth = np.array([true_goal(k * dt) for k in range(round(LENGTH_S / dt))])
    steps = compute_steps(truth)
    found = []
    for stream in STREAMS:
        filled = np.ascontiguousarray(goals(stream, dt))
        made = compute_steps(filled)
        goal = {"goal_rate_ratio": made.max() / steps.max(), "goal_way_ratio": made.sum() / steps.sum()}
        for law in (*laws, *[""] * stream.arrives.startswith(SIGNED)):
            one = find_contender(law or laws[0])
            peak, off, way = run_stream(one, filled, truth, request.gains, dt, is_raw=not law)
            loop = {"peak_u": peak, "off_rad": off, "way_ratio": way / steps.sum()}
            found.append({"stream": stream.name, "law": law, **goal, **loop})
    return found


def compute_steps(q: np.ndarray) -> np.ndarray:
    """Compute the angles between neighbouring goals [rad]."""
    return np.array([angle(before, after) for before, after in zip(q[:-1].tolist(), q[1:].tolist(), strict=True)])


EXPERIMENT = Experiment.of(
    globals(),
    "goals that arrive as a stream",
    cost_s=lambda unit: 1.0,
    compiles=False,
)
