"""Does the step matter? The angle at one moment, against the step, for every engine that integrates.

The reference is the continuous plant at the finest step. RK4 should err by the fourth power of the step; a plant
that is sampled, or integrated by MuJoCo's Euler, by the first: that is what it is, not an error of the program.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.engines.episode import FINAL_ANGLE, Settings
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate import run
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains
from report.figures.kit.laws import TITLES
from tasks import start_set

AT_S = 0.4
"""Most of the response is still under way, and every step below divides it."""
STEPS_S = (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)
FINEST_S = 1.25e-4
ENGINES = ("ideal-rk4", "ideal-held", "native")
STARTS = dict(zip(TITLES, ("figure-2.3", "figure-2.4", "figure-2.5"), strict=True))
"""Each law from the start of its own figure of the paper."""


def settings(dt_s: float) -> Settings:
    """Return the paper's gains to AT_S, without an early stop, by steps of one length."""
    ticks = round(AT_S / dt_s)
    return Settings(Gains(), dt_s, ticks, ticks + 1)


def angle_at(engine: str, name: str, start_id: str, dt_s: float) -> float:
    """Angle to the goal at AT_S from one of the `paper` starts [rad]."""
    starts = [start for start in start_set("paper") if start.id == start_id]
    as_in_a_run = metrics_of(on_arm=False)  # with which the loops are compiled already
    given = find_contender(name), "free-body", starts, settings(dt_s), as_in_a_run
    return float(run(engine, *given, converge=False)[0, FINAL_ANGLE])


def errors() -> pd.DataFrame:
    """Deviation from the finest continuous run: a row an engine, law and step."""
    return pd.DataFrame([row for name, start_id in STARTS.items() for row in _errors_of(name, start_id)])


def _errors_of(name: str, start_id: str) -> list[dict]:
    truth = angle_at("ideal-rk4", name, start_id, FINEST_S)
    return [
        {
            "contender": name,
            "engine": engine,
            "dt_s": dt_s,
            "error_rad": abs(angle_at(engine, name, start_id, dt_s) - truth),
        }
        for engine in ENGINES
        for dt_s in STEPS_S
    ]


def orders(found: pd.DataFrame) -> pd.DataFrame:
    """Slope of log error against log step from the largest step to the next, a column an engine, a row a law."""
    coarse, finer = STEPS_S[0], STEPS_S[1]
    table = found.pivot_table(index=["contender", "engine"], columns="dt_s", values="error_rad")
    slope = np.log(table[coarse] / table[finer]) / np.log(coarse / finer)
    return slope.unstack("engine")[[*ENGINES]]
