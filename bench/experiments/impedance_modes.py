"""Impedance without inertia shaping about the goal: natural frequency and damping ratio felt of every mode."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bench.experiments import impedance
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "impedance-modes"

DESIGN_S = 0.01
"""CPU seconds a design of damping on an arm."""


def units(asked: Asked) -> tuple[Unit, ...]:
    """The designs on arms."""
    return impedance.of_arms(asked, NAME)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row a mode."""
    from bench.experiments.rows.impedance_modes import frame

    return frame(settings, unit)


EXPERIMENT = Experiment(
    NAME,
    "modes of impedance without inertia shaping",
    TABLES[NAME],
    units,
    rows,
    takes=("tasks", "arms"),
    cost_s=lambda unit: DESIGN_S,
    prepare=impedance.prepare,
    compiles=False,
)
