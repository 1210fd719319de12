"""The same starts on every engine: how much later or earlier each law settles than on the continuous plant."""

from __future__ import annotations

import pandas as pd

from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.laws import TITLES
from report.figures.method.steps import ENGINE_TITLES

KEY = ["contender", "start_set", "start_id"]
CONTINUOUS, SAMPLED = "ideal-rk4", ("ideal-held", "native")
QUANTILES = (0.05, 0.5, 0.95)


def differences(episodes: pd.DataFrame) -> pd.DataFrame:
    """Settling time on a sampled engine minus that on the continuous one [s], uniform starts that settle on both."""
    uniform = episodes[episodes["start_set"] == "uniform"]
    times = uniform.pivot_table(index=KEY, columns="engine", values="settling_time_s", observed=True)
    there = [engine for engine in SAMPLED if engine in times]
    parts = [
        (times[engine] - times[CONTINUOUS]).dropna().rename("later_s").reset_index().assign(engine=engine)
        for engine in there
    ]
    return pd.concat(parts, ignore_index=True)


def summary(found: pd.DataFrame) -> pd.DataFrame:
    """Quantiles and mean of the difference, in order of the paper: a row a law and engine."""
    rows = []
    for name in TITLES:
        for engine in SAMPLED:
            one = found.loc[(found["contender"] == name) & (found["engine"] == engine), "later_s"]
            if len(one):
                low, middle, high = one.quantile(QUANTILES)
                rows.append((name, engine, len(one), low, middle, high, one.mean(), one.min(), one.max()))
    columns = ["contender", "engine", "n", "low_s", "median_s", "high_s", "mean_s", "least_s", "most_s"]
    return pd.DataFrame(rows, columns=columns)


def agreement(episodes: pd.DataFrame, one: str, other: str) -> tuple[int, int]:
    """How many episodes both engines ran, and in how many of them all judged numbers are equal bit for bit."""
    judged = [
        "outcome",
        "settling_time_s",
        "failure_time_s",
        "final_angle_rad",
        "effort",
        "path_ratio",
        "peak_u",
        "ticks",
    ]
    first, second = (episodes[episodes["engine"] == engine].set_index(KEY)[judged] for engine in (one, other))
    both = first.index.intersection(second.index)
    first, second = first.loc[both].astype({"outcome": str}), second.loc[both].astype({"outcome": str})
    equal = (first == second) | (first.isna() & second.isna())
    return len(both), int(equal.all(axis=1).sum())


def same_outcome(episodes: pd.DataFrame, other: str) -> pd.DataFrame:
    """Episodes that ran on the continuous plant and on another engine, a row a law: how many end alike.

    Columns: n, outcome (the same one of six), settles (both settle, or neither).
    """
    outcomes = episodes.pivot_table(index=KEY, columns="engine", values="outcome", aggfunc="first", observed=True)
    both = outcomes[[CONTINUOUS, other]].dropna().astype(str)
    one, two = both[CONTINUOUS], both[other]
    alike = pd.DataFrame({"n": 1, "outcome": one == two, "settles": (one == "settled") == (two == "settled")})
    return alike.astype(int).groupby("contender", observed=True).sum().reset_index()


@responsive_picture
def engines(found: pd.DataFrame, *, narrow=False):
    """Median and 5 to 95 % of the difference in settling time, by law and engine."""
    table = summary(found)
    figure, axes = style.panels(height=(1.1 if narrow else 0.9) + 0.36 * len(table), narrow=narrow)
    for place, row in enumerate(table.itertuples()):
        look = style.look(row.contender)
        axes.plot([1e3 * row.low_s, 1e3 * row.high_s], [place, place], color=look.colour, linewidth=3.2, alpha=0.55)
        face = look.colour if row.engine == "native" else style.PAPER
        axes.plot(1e3 * row.mean_s, place, look.marker, color=look.colour, markersize=7.5, markerfacecolor=face)
    names = [f"{TITLES[row.contender]}\n{ENGINE_TITLES[row.engine]}" for row in table.itertuples()]
    axes.set_yticks(range(len(table)), names, fontsize=9)
    axes.invert_yaxis()
    axes.set_ylim(len(table) - 0.4, -0.6)
    axes.axvline(0.0, color=style.MUTED, linewidth=0.9)
    style.listed(axes)
    axes.set_xlabel("Settles later by [ms]" if narrow else "Settles later than on the continuous plant by [ms]")
    words = "; ".join(
        f"{TITLES[row.contender]} on {ENGINE_TITLES[row.engine]} {1e3 * row.mean_s:+.1f} ms"
        for row in table.itertuples()
    )
    return figure, f"Mean difference in settling time to the continuous plant, with its 5 to 95 % range: {words}."
