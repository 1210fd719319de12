"""Impedance as torque-controlled arms run it, tau = J^T (K e - D v) + g, in free motion: every design of the damping.

Each at the stiffness of libfranka's example and at that of our tasks in contact, with gravity alone compensated and
with Coriolis torques too; the error of orientation is the logarithm.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bench.base.on_first_use import pd
from bench.engines.episode import FINAL_ANGLE
from bench.experiments import arm, starts
from bench.experiments.episode_rows import episode_columns
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.request import Request
from bench.experiments.suites import BY_EVERY_INVERSE, ON_ARM
from bench.law.contenders.registry import find_contender
from bench.law.control.unshaped import DAMPINGS

LAW = BY_EVERY_INVERSE
"""The law whose command at rest is the error of orientation: near the goal all are alike."""


class Stiffness(NamedTuple):
    """Stiffness of translation [N/m] and of rotation [N m/rad]."""

    translation: float
    rotation: float


STIFFNESSES = (Stiffness(150.0, 10.0), Stiffness(2000.0, 50.0))
"""libfranka's example, and kp m_p, kp m_o of the tasks in contact."""

ZETA = 1.0
"""The ratio asked for: the shipped rule's 2 sqrt(K)."""

START_SET = "clear"
COMPENSATED = ("gravity", "bias")
"""In the order of `Springs.is_whole`."""
UNBOUNDED = ("overshoot", "off_m", "strain", "left_j", "damped_j", "elbow_j", "added_j")
"""Columns set to NaN when the episode diverged: they say how far it got by the tick at which it was stopped."""

EPISODE_S = 0.02
"""CPU seconds an episode of five seconds at most, median."""


def units_on_arms(request: Request, name: str, **more: Any) -> tuple[Unit, ...]:
    """Return a unit a design of damping on each arm of the plan."""
    arms = dict.fromkeys(unit.arm for unit in arm.units(request))
    return tuple(Unit(name, task="arm-regulation", arm=one, selector=word, **more) for one in arms for word in DAMPINGS)


def units(request: Request) -> tuple[Unit, ...]:
    """Return the designs on arms."""
    count = request.section("impedance")["starts"]
    return units_on_arms(request, "impedance", count=count, total=count, horizon_s=ON_ARM)


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return one row an episode."""
    some, both = starts.on_arm(START_SET, unit.count, request.seed, unit.arm), range(len(COMPENSATED))
    made = [_rows(request, unit, some, stiffness, whole) for stiffness in STIFFNESSES for whole in both]
    frame = pd.concat(map(pd.DataFrame, made), ignore_index=True)
    frame.loc[frame["failure_time_s"].notna(), list(UNBOUNDED)] = np.nan
    return frame


def _rows(request: Request, unit: Unit, some: list, stiffness: Stiffness, whole: int) -> dict:
    from bench.engines.plants.impedance import ADDED, DAMPED, ELBOW, KINETIC, LEFT, OFF, OVERSHOOT, STRAIN, Springs
    from bench.engines.simulate_arms import run_impedance as run

    law, damping = find_contender(LAW), DAMPINGS[unit.selector]
    springs = Springs(*stiffness, ZETA, whole)
    numbers, _ = run(law, damping, springs, some, request.limits(unit.horizon_s), unit.arm)
    ran = episode_columns(request, some, numbers, request.dt_s, unit.horizon_s)
    left = compute_potential(stiffness, numbers[:, FINAL_ANGLE], numbers[:, LEFT]) + numbers[:, KINETIC]
    return {
        **ran,
        **setting_columns(unit, stiffness),
        "compensated": COMPENSATED[whole],
        "law": LAW,
        "start_set": START_SET,
        "overshoot": numbers[:, OVERSHOOT],
        "off_m": numbers[:, OFF],
        "strain": numbers[:, STRAIN],
        "stored_j": compute_potential(stiffness, ran["angle0_rad"], np.zeros(len(some))),
        "left_j": left,
        "damped_j": numbers[:, DAMPED],
        "elbow_j": numbers[:, ELBOW],
        "added_j": numbers[:, ADDED],
    }


def setting_columns(unit: Unit, stiffness: Stiffness) -> dict:
    """Return the values of the columns DESIGN."""
    return {
        "arm": unit.arm,
        "damping": unit.selector,
        "stiffness_n_m": stiffness.translation,
        "stiffness_nm_rad": stiffness.rotation,
        "zeta": ZETA,
    }


def compute_potential(stiffness: Stiffness, theta: np.ndarray, distance: np.ndarray) -> np.ndarray:
    """Compute the energy of the springs [J]: k_r theta^2/2 of the logarithm, and k_t |p_d - p|^2/2."""
    return 0.5 * (stiffness.rotation * theta**2 + stiffness.translation * distance**2)


def prepare(request: Request, unit: Unit) -> None:
    """Compile the loop, the error and the design."""
    _rows(request, unit, [], STIFFNESSES[0], whole=0)


EXPERIMENT = Experiment.of(
    globals(),
    "impedance without inertia shaping, in free motion",
    takes=("tasks", "arms"),
    cost_s=lambda unit: 2.0 * len(STIFFNESSES) * unit.count * EPISODE_S,
    compiles=False,
)
