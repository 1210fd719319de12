"""What a run held fixed, as a table, and the closed form that the gains imply."""

from __future__ import annotations

import pandas as pd

from bench.findings.theory.closed_form import linear_settling
from report.figures.kit import html

YES, NO = "yes", "no: ours"


def held(episodes: pd.DataFrame) -> html.Markdown:
    """Gains, step, horizon, band: every value that occurs in the run, and whether the paper states it."""
    horizons = [f"{value:g}" for value in sorted(episodes["horizon_s"].unique())]
    facts = [
        ("Position gain $K_p$", values(episodes, "kp", "1/s²"), "yes, but for regulator 1"),
        ("Velocity gain $K_v$, $K_d$", values(episodes, "kv", "1/s"), "yes, but for regulator 1"),
        ("Inertia", "identity", YES),
        ("Control period and step", values(episodes, "dt_s", "s"), NO),
        ("Horizon", f"{' or '.join(horizons)} s, by start set", NO),
        ("Settling band", f"{values(episodes, 'tolerance', '')} of the initial angle", NO),
        ("Engines", ", ".join(f"`{name}`" for name in sorted(episodes["engine"].unique())), "one: Simnon"),
        ("Orientations", f"{html.number(starts(episodes))} starts a law", NO),
    ]
    return html.table(pd.DataFrame(facts, columns=["What", "Value", "Paper"]))


def values(episodes: pd.DataFrame, column: str, unit: str) -> str:
    """Every value of a column, with its unit."""
    return f"{', '.join(f'{value:g}' for value in sorted(episodes[column].unique()))} {unit}".strip()


def starts(episodes: pd.DataFrame) -> int:
    """Different starts of the continuous plant."""
    return len(episodes.loc[episodes["engine"] == "ideal-rk4", ["start_set", "start_id"]].drop_duplicates())


def uniform_starts(episodes: pd.DataFrame) -> str:
    """How many uniform starts a law met on the continuous plant; from fewest to most where laws differ."""
    mine = episodes[(episodes["start_set"] == "uniform") & (episodes["engine"] == "ideal-rk4")]
    counts = mine["contender"].astype(str).value_counts()
    fewest, most = (html.number(counts.iloc[place]) for place in (-1, 0))
    return most if fewest == most else f"{fewest} to {most}"


def small_error_settling_s(episodes: pd.DataFrame) -> float:
    """Settling time of a small error, from the closed form and the run's gains and band [s]."""
    kp, kv, band = (float(episodes[column].iloc[0]) for column in ("kp", "kv", "tolerance"))
    return linear_settling(kp, kv, band)
