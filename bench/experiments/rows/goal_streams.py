"""Rows of goals that arrive as a stream: what a filter makes of the goal, and what a loop makes of that."""

import numpy as np
import pandas as pd

from bench.contenders.registry import find_contender
from bench.engines.streamed import run
from bench.experiments.experiment import Settings
from bench.tables.schema import TABLES
from tasks.goal_stream import LENGTH_S, STREAMS, goals, true_goal
from tasks.truth import angle

SIGNED = "quaternion,"
"""Of streams that arrive so, the spring on the quaternion as it came is run too."""


def frame(settings: Settings, laws: list[str]) -> pd.DataFrame:
    """A row a stream and law; `law` is empty of the spring on the quaternion as it came."""
    dt = settings.dt_s
    truth = np.array([true_goal(k * dt) for k in range(round(LENGTH_S / dt))])
    steps = turned_by(truth)
    found = []
    for stream in STREAMS:
        filled = np.ascontiguousarray(goals(stream, dt))
        made = turned_by(filled)
        goal = {"goal_rate_ratio": made.max() / steps.max(), "goal_way_ratio": made.sum() / steps.sum()}
        for law in (*laws, *[""] * stream.arrives.startswith(SIGNED)):
            seen = run(find_contender(law or laws[0]), filled, truth, settings.gains, dt, is_raw=not law)
            loop = {"peak_u": seen.peak_u, "off_rad": seen.off_rad, "way_ratio": seen.way_rad / steps.sum()}
            found.append({"stream": stream.name, "law": law, **goal, **loop})
    return pd.DataFrame(found, columns=TABLES["goal-streams"].names)


def turned_by(q: np.ndarray) -> np.ndarray:
    """Angles between neighbouring goals [rad]."""
    return np.array([angle(before, after) for before, after in zip(q[:-1].tolist(), q[1:].tolist(), strict=True)])
