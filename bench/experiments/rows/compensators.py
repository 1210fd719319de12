"""Rows of laws with a state: how they settle and what is left, from starts all over SO(3), under each disturbance."""

import numpy as np
import pandas as pd

import tasks
from bench.contenders.registry import known_compensators, papers_laws
from bench.engines.compensated import LEFT, PEAK, SETTLED, Asked, run, without_state
from bench.experiments.experiment import Settings, Unit
from bench.law.compensator import Compensator
from bench.tables.schema import TABLES
from tasks.rules import ticks

BAND_RAD = np.deg2rad(1.0)
"""The same for all starts: a disturbance leaves what it leaves wherever the body came from."""
DIRECTION = (1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0)
"""Of the disturbance, in the base frame."""


def law_of(name: str) -> Compensator:
    """The law of that name; of none, the paper's on R, whose spring they have."""
    if name:
        return known_compensators()[name]
    return without_state(next(one for one in papers_laws() if one.representation is None).regulator)


def frame(settings: Settings, unit: Unit, disturbances: tuple[float, ...]) -> pd.DataFrame:
    """A row a level of the disturbance."""
    one, starts = law_of(unit.selector), tasks.start_set("uniform", unit.count, seed=settings.seed)
    found = []
    for level in disturbances:
        pushed = (level * x for x in DIRECTION)
        asked = Asked(settings.dt_s, float(ticks(unit.horizon_s, settings.dt_s)), float(BAND_RAD), *pushed)
        made = run(one, starts, settings.gains, asked)
        times = made[np.isfinite(made[:, SETTLED]), SETTLED]
        found.append(
            {
                "law": one.name,
                "disturbance": level,
                "reads_rate": "yes" if one.measures_rate else "no",
                "kp": settings.gains.kp,
                "kv": settings.gains.kv,
                "dt_s": settings.dt_s,
                "horizon_s": unit.horizon_s,
                "starts": len(starts),
                "settled": len(times),
                "settling_median_s": float(np.median(times)) if len(times) else None,
                "settling_worst_s": float(np.max(times)) if len(times) else None,
                "left_rad": float(np.max(made[:, LEFT])),
                "peak_u": float(np.max(made[:, PEAK])),
            }
        )
    return pd.DataFrame(found, columns=TABLES["compensators"].names)
