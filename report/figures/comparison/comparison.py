"""The page that compares all laws: on the same uniform starts, at the same gains and at the same peak command."""

import functools
import math
from collections.abc import Callable, Iterator

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation

from bench.experiments.tables.run import FREE_BODY, Run, converged
from bench.experiments.tables.statistics import Estimate, quantile_estimate
from bench.findings.claims.tables import share
from bench.findings.selection import tables as compared
from bench.findings.selection.run_rows import compare_run
from bench.findings.start_sets import AT_REST
from report.figures.comparison.equal_peak import describe_slopes, list_tuned, write_table
from report.figures.cost.cost import CALLS, totals
from report.figures.kit import families, html
from report.figures.kit.page import in_run
from report.figures.kit.spelling import power

ALL_LAWS = html.PageTable(
    "Law | Starts that settle [%] | Settling time for 50 % of starts [s] | Settling time for 99 % of starts [s] | "
    "Median effort [rad²/s³] | Peak command [rad/s²] | Operations + function calls per control step | "
    "Directed starts from which the body never settles | "
    "Sensor error that traps the body at 180° [rad]"
)
NEAR_DEG = 30, 60
ANISOTROPIC = "weighted-columns"
"""Its stiffness is the others' on the average over its axes alone."""
NEVER = "never"
SMALL_PEAK = 1e4
"""Commands [rad/s^2] above this are those of a division by nearly nothing."""


@functools.cache
def ideal(run: Run) -> pd.DataFrame:
    """Episodes of the free body on the continuous plant."""
    return run.rows("episodes", engine="ideal-rk4", **FREE_BODY)


@functools.cache
def uniform(run: Run) -> pd.DataFrame:
    """Return the episodes from uniform starts that every law ran."""
    return common(ideal(run))


def facts(run: Run) -> dict:
    """Return the numbers of the laws that are not negative controls, and the table of all laws."""
    rows, tried = uniform(run), directed_starts(ideal(run))
    times, efforts = costs(rows, "settling_time_s"), costs(rows, "effort")
    laws = [name for name in times if name not in families.CONTROLS]
    middle, spent = (table[laws].quantile(interpolation="lower") for table in (times, efforts))
    lost = set(tried.loc[tried["outcome"] != "settled", "contender"])
    return {
        "laws": len(laws),
        "starts": len(times),
        "kp": float(rows["kp"].iloc[0]),
        "kv": float(rows["kv"].iloc[0]),
        "fastest_s": f"{middle.min():.2f}",
        "slowest_s": f"{middle.max():.2f}",
        "whole": int(sum(np.isfinite(times[name]).all() for name in laws)),
        "dearer": f"{spent.max() / spent.min():.0f}",
        **near(rows[rows["contender"].isin(laws)]),
        "left": len(set(tried["contender"]) - lost - set(families.CONTROLS)),
        "tuned": in_run(write_table),
        "tuned_finding": in_run(lambda: describe_slopes(list_tuned())),
        "all_laws": ALL_LAWS(compare_laws(run, times, efforts)),
    }


def near(rows: pd.DataFrame) -> dict:
    """Return by how much the laws' medians from starts near the goal differ, weighted columns aside."""
    found: dict = {}
    for angle in NEAR_DEG:
        own = rows[(rows["angle0_rad"] < np.radians(angle)) & (rows["contender"] != ANISOTROPIC)]
        middles = own.groupby(own["contender"].astype(str))["settling_time_s"].median()
        apart = f"{math.ceil(100.0 * (middles.max() / middles.min() - 1.0) - 1e-9)}"  # "or less"
        found |= {f"within_{angle}": own["start_id"].nunique(), f"apart_{angle}": apart}
    return found


def compare_laws(run: Run, times: pd.DataFrame, efforts: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a law: what settles, how fast, effort, peak, a tick, lost starts, what noise holds."""
    rows, tried, counted = uniform(run), directed_starts(ideal(run)), run.any_rows("costs", **FREE_BODY)
    held = in_run(lambda: list_held(run)) or {}
    for name in families.in_order(times):
        own, sure = rows[rows["contender"] == name], converged(tried[tried["contender"] == name])
        yield (
            families.link(name, families.word(name)),
            with_interval(*map(percent, share(own["outcome"] == "settled")[2:])),
            seconds(times[name]),
            seconds(times[name], 0.99),
            html.number(float(f"{efforts[name].quantile(interpolation='lower'):.3g}")),
            large(own["peak_u"].max()),
            tick(counted, name),
            count_lost(sure) if len(sure) else html.UNTESTED,
            html.cell(held[name]) if name in held else html.UNTESTED,
        )


def list_held(run: Run) -> dict[str, float]:
    """Return the least noise tried that traps each law at 180°; laws that were not tried are missing."""
    rows = compare_run(run.folder).rows.dropna(subset="held")
    return dict(zip(rows["contender"], rows["held"], strict=True))


def count_lost(rows: pd.DataFrame) -> str:
    """Return "25 of 666" or "none of 372" for the starts that do not settle."""
    lost = int((rows["outcome"] != "settled").sum())
    return html.no_break(f"{lost or 'none'} of {len(rows)}")


def common(episodes: pd.DataFrame) -> pd.DataFrame:
    """Return one engine's rows of uniform starts that every law ran, none judged by easier ones; family by family."""
    rows = compared.common(episodes[(episodes["start_set"] == "uniform") & (episodes["arm"] == "")])
    names = families.in_order(rows["contender"].unique())
    ordered = rows.assign(contender=pd.Categorical(rows["contender"].astype(str), names, ordered=True))
    return ordered.sort_values(["contender", "start_id"], ignore_index=True)


def costs(rows: pd.DataFrame, column: str) -> pd.DataFrame:
    """Return a column by start and law, infinite where the law did not settle: shape (starts, laws)."""
    settled = rows["outcome"] == "settled"
    return rows.assign(cost=rows[column].where(settled, np.inf)).pivot(
        index="start_id", columns="contender", values="cost"
    )


def tick(counted: pd.DataFrame, name: str) -> str:
    """Return flops and calls of a typical tick, as "45 + 6"; counted: rows of costs.parquet about the free body."""
    if name not in set(counted["contender"]):
        return html.MISSING
    own = totals(counted).loc[name]
    flops, calls = int(own["flops"]), int(own[list(CALLS)].sum())
    return f"{flops} + {calls}" if calls else (f"{flops}" if flops else html.MISSING)


def percent(part: float) -> str:
    """Return a share in per cent, to a tenth, whole where it is all or nothing."""
    return f"{100 * part:.0f}" if part in (0.0, 1.0) else f"{100 * part:.1f}"


def seconds(values: pd.Series, level: float = 0.5) -> str:
    """Return a quantile of times with its interval; among the failures it is never reached."""
    return spelled(quantile_estimate(values.to_numpy(), level), lambda value: f"{value:.3f}")


def large(value: float) -> str:
    """Return a number to three figures, or as a power of ten where it stands for no bound."""
    return html.number(float(f"{value:.3g}")) if value < SMALL_PEAK else power(value)


def spelled(found: Estimate, write: Callable[[float], str]) -> str:
    """Return an estimate as words; where both ends are the number itself, the number alone."""
    value, low, high = (write(one) if np.isfinite(one) else NEVER for one in found)
    return value if value == low == high else with_interval(value, low, high)


def with_interval(value: str, low: str, high: str) -> str:
    """Return a number, and its interval, which no line breaks."""
    return f"{value} {html.no_break(f'({low} to {high})')}"


def directed_starts(episodes: pd.DataFrame) -> pd.DataFrame:
    """Directed starts at rest, each orientation once a law, though several sets have it; rows of one engine."""
    rows = episodes[episodes["start_set"].isin(AT_REST) & (episodes["arm"] == "")]
    return rows[~orientation(rows).assign(contender=rows["contender"]).duplicated()]


def orientation(rows: pd.DataFrame) -> pd.DataFrame:
    """R, which both quaternions of an orientation share, to the last digit but three."""
    turns = Rotation.from_quat(rows[["quat_w", "quat_x", "quat_y", "quat_z"]].to_numpy(), scalar_first=True)
    return pd.DataFrame(turns.as_matrix().reshape(-1, 9).round(13), rows.index)
