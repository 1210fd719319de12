"""What the page on the plant shows: what a run held fixed."""

from __future__ import annotations

import pandas as pd

from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.rows import small_error_settling_s
from report.figures.kit.tables import Table

YES, NO = "yes", "no: ours"
HELD = Table("What | Value | Paper")


def facts(run: Run) -> dict:
    """What the gains imply."""
    return {"small": f"{small_error_settling_s(run.rows('episodes', task='free-body')):.3f}"}


def tables(run: Run) -> dict:
    """Gains, step, horizon, band: every value that occurs in the run, and whether the paper states it."""
    episodes = run.rows("episodes", task="free-body")
    horizons = [f"{value:g}" for value in sorted(episodes["horizon_s"].unique())]
    held = [
        ("Position gain $K_p$", values(episodes, "kp", "1/s²"), "yes, but for regulator 1"),
        ("Velocity gain $K_v$, $K_d$", values(episodes, "kv", "1/s"), "yes, but for regulator 1"),
        ("Inertia", "identity", YES),
        ("Control period and step", values(episodes, "dt_s", "s"), NO),
        ("Horizon", f"{' or '.join(horizons)} s, by start set", NO),
        ("Settling band", f"{values(episodes, 'tolerance', '')} of the initial angle", NO),
        ("Engines", ", ".join(f"`{name}`" for name in sorted(episodes["engine"].unique())), "one: Simnon"),
        ("Orientations", f"{html.number(starts(episodes))} starts a law", NO),
    ]
    return {"held": HELD(held)}


def values(episodes: pd.DataFrame, column: str, unit: str) -> str:
    """Every value of a column, with its unit."""
    return f"{', '.join(f'{value:g}' for value in sorted(episodes[column].unique()))} {unit}".strip()


def starts(episodes: pd.DataFrame) -> int:
    """Different starts of the continuous plant."""
    return len(episodes.loc[episodes["engine"] == "ideal-rk4", ["start_set", "start_id"]].drop_duplicates())
