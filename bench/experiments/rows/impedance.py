"""Episodes of impedances that shape no inertia, and their rows: how they ended, and where their energy went."""

import numpy as np
import pandas as pd

from bench.contenders.registry import find_contender, known_dampings
from bench.engines.episode import FINAL_ANGLE
from bench.engines.plants.impedance import ADDED, DAMPED, ELBOW, KINETIC, LEFT, OFF, OVERSHOOT, STRAIN, Springs
from bench.engines.simulate_arms import run_impedance as run
from bench.experiments import starts
from bench.experiments.experiment import Settings, Unit
from bench.experiments.impedance import LAW, STIFFNESSES, ZETA, Stiffness
from bench.experiments.rows.episodes import judged_columns
from bench.tables.schema import TABLES
from tasks.truth import angle

START_SET = "clear"
COMPENSATED = ("gravity", "bias")
"""In the order of `Springs.is_whole`."""
UNBOUNDED = ("overshoot", "off_m", "strain", "left_j", "damped_j", "elbow_j", "added_j")
"""What means nothing of an episode that diverged: how far it got by the tick at which it was stopped."""


def frame(settings: Settings, unit: Unit) -> pd.DataFrame:
    """The rows of a unit."""
    some = starts.on_arm(START_SET, unit.count, settings.seed, unit.arm)
    made = [
        _rows(settings, unit, stiffness, whole, some) for stiffness in STIFFNESSES for whole in range(len(COMPENSATED))
    ]
    return pd.concat(made, ignore_index=True)[TABLES["impedance"].names]


def _rows(settings: Settings, unit: Unit, stiffness: Stiffness, whole: int, some) -> pd.DataFrame:
    law, damping = find_contender(LAW), known_dampings()[unit.selector]
    springs = Springs(*stiffness, ZETA, whole)
    numbers, _ = run(law, damping, springs, some, settings.limits(unit.horizon_s), unit.arm)
    angle0 = np.array([angle(start.quat_wxyz, start.goal_wxyz) for start in some])
    left = potential(stiffness, numbers[:, FINAL_ANGLE], numbers[:, LEFT]) + numbers[:, KINETIC]
    made = pd.DataFrame(
        {
            "suite": settings.suite,
            **what(unit, stiffness),
            "compensated": COMPENSATED[whole],
            "law": LAW,
            "start_set": START_SET,
            "start_id": [start.id for start in some],
            "angle0_rad": angle0,
            "dt_s": settings.dt_s,
            "horizon_s": unit.horizon_s,
            **judged_columns(numbers, settings.dt_s),
            "overshoot": numbers[:, OVERSHOOT],
            "off_m": numbers[:, OFF],
            "strain": numbers[:, STRAIN],
            "stored_j": potential(stiffness, angle0, np.zeros(len(some))),
            "left_j": left,
            "damped_j": numbers[:, DAMPED],
            "elbow_j": numbers[:, ELBOW],
            "added_j": numbers[:, ADDED],
        }
    )
    made.loc[made["failure_time_s"].notna(), list(UNBOUNDED)] = np.nan
    return made


def what(unit: Unit, stiffness: Stiffness) -> dict:
    """The columns that say what is looked at."""
    return {
        "arm": unit.arm,
        "damping": unit.selector,
        "stiffness_n_m": stiffness.translation,
        "stiffness_nm_rad": stiffness.rotation,
        "zeta": ZETA,
    }


def potential(stiffness: Stiffness, theta: np.ndarray, distance: np.ndarray) -> np.ndarray:
    """Energy of the springs [J]: k_r theta^2/2 of the logarithm, and k_t |p_d - p|^2/2."""
    return 0.5 * (stiffness.rotation * theta**2 + stiffness.translation * distance**2)
