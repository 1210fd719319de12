"""Laws as exported C++ in real time, against the simulated loop and theory; from results/real-time."""

import functools

import numpy as np
import pandas as pd

from bench.base.files import read_json
from bench.experiments.tables.run import Run
from bench.experiments.tables.store import read
from bench.findings.amounts import count_of, join_words
from bench.findings.real_time import GREATEST, HALVINGS, PERIOD_S, STUDY
from bench.findings.theory.late_torques import find_alternating_limit, find_constant_limit
from report.figures.arms import arm_rows
from report.figures.kit import families, html, style
from report.figures.kit.inline import Drawing, responsive_picture

LOOPS = html.PageTable(
    "Arm | Law | Substeps in a period | Episodes | Episodes that settle in real time "
    "| Episodes that settle in simulation | Episodes with the same outcome in real time and in simulation "
    "| Median delay [µs] | 99th percentile of the delay [µs] | Longest delay [µs]"
)
GAINS = html.PageTable(
    "Arm | Law | Substeps in a period | Largest Kv in real time [1/s] "
    "| Largest Kv predicted from measured delays [1/s] | Largest Kv with replayed delays [1/s] "
    "| Largest Kv predicted from replayed delays [1/s]"
)
PARTS = html.PageTable("Part of the delay | Median [µs] | 99th percentile [µs] | Longest [µs]")
PART_NAMES = {
    "published": "From the start of the control period until the arm's process has written the state",
    "read": "From the writing of the state until the controller's process has read this state",
    "written": "From the reading of the state until the controller's process has written the torques",
    "noticed": "From the writing of the torques until the arm's process has read these torques (not counted as delay)",
}
STATISTICS = ("median", "p99", "max")
DELAYS = np.linspace(0.0, 1.0, 401)
"""Shares of the period, for the curve."""
SHOWN_DELAY = 0.3
"""The end of the drawn delays: what is measured, and where the branch changes, lies before it."""


@functools.cache
def rows() -> pd.DataFrame:
    """Return a row for each arm, law and number of substeps."""
    return read(STUDY, "real_time").astype({"arm": str, "regulator": str})


def facts(_: Run) -> dict:
    """Return what it was measured on, what the loops did, and how far simulation and theory are off."""
    about, study = read_json(STUDY / "provenance.json"), rows()
    live_gaps = (study["kv_predicted"] / study["kv_measured"] - 1.0).abs()
    replay_gaps = (study["kv_replay_predicted"] / study["kv_replayed"] - 1.0).abs()
    medians = study.groupby("substeps")["kv_measured"].median()
    greatest_delay, greatest = find_greatest_limit()
    return {
        "machine": f"{about['cpu']}, {about['cores']} cores",
        "scheduling": about["scheduling"],
        "load": about["load_before"],
        "resolution": f"{1e9 * study['resolution_s'].max():.0f}",
        "agreeing": count_of(int(study["agreeing"].sum()), int(study["starts"].sum()), "episodes"),
        "apart_ms": f"{1e3 * study['time_difference_s'].max():.1f}",
        "gap": f"{100 * live_gaps.max():.1f}",
        "replay_gap": f"{100 * replay_gaps.max():.1f}",
        "medians": join_words(
            f"{html.number(round(median))}/s with {substeps} substeps" for substeps, median in medians.items()
        ),
        "substeps_gap": f"{100 * (medians.max() / medians.min() - 1.0):.1f}",
        "replay_substeps_gap": describe_spread(spread_of_replays(study)),
        "step": f"{100 * GREATEST / 2**HALVINGS / PERIOD_S / study['kv_measured'].median():.1g}",
        "undelayed": format_limit(0.0),
        "eighth": format_limit(0.125),
        "half": format_limit(0.5),
        "rates_eighth": f"{2.0 / (1.0 - 2.0 * 0.125):.2f}",
        "whole_eighth": f"{find_constant_limit(0.125):.2f}",
        "peak": f"{greatest:.2f}",
        "peak_delay": f"{greatest_delay:.3f}",
        "limits": limits(study),
        "parts": PARTS(describe_parts(study)),
        "loops": LOOPS(describe_episodes(row) for _, row in study.iterrows()),
        "gains": GAINS(describe_gains(row) for _, row in study.iterrows()),
    }


def spread_of_replays(study: pd.DataFrame) -> float:
    """Return how far the limits of an arm and law with the same delays are apart, at most, as a share."""
    limits = study.groupby(["arm", "regulator"])["kv_replayed"].agg(["min", "max"])
    return float((limits["max"] / limits["min"] - 1.0).max())


def describe_spread(share: float) -> str:
    """Say by how much limits differ."""
    return f"differ by at most {100 * share:.1g} %" if share else "are equal"


def find_greatest_limit() -> tuple[float, float]:
    """Return the delay [periods] with the greatest limit, and this Kv T."""
    coarse = DELAYS[np.argmax(constant_limits())]
    delays = np.linspace(coarse - 0.005, coarse + 0.005, 101)
    gains = [find_constant_limit(delay) for delay in delays]
    place = int(np.argmax(gains))
    return float(delays[place]), gains[place]


@functools.cache
def constant_limits() -> np.ndarray:
    """Return the greatest stable Kv T at each of DELAYS."""
    return np.array([find_constant_limit(delay) for delay in DELAYS.tolist()])


def format_limit(delay: float) -> str:
    """Return the greatest stable Kv [1/s] with a constant delay, a share of the period."""
    return html.number(round(find_constant_limit(delay) / PERIOD_S))


def describe_parts(study: pd.DataFrame) -> list[tuple]:
    """Return a row for each part of the delay: medians of the loops, and the longest of all."""
    cells = []
    for part, words in PART_NAMES.items():
        median, p99 = (1e6 * study[f"{part}_{name}_s"].median() for name in STATISTICS[:2])
        longest = 1e6 * study[f"{part}_max_s"].max()
        cells.append((words, f"{median:.2f}", f"{p99:.1f}", html.number(round(longest))))
    return cells


def name_loop(row: pd.Series) -> tuple:
    """Return the cells that say which loop a row is about."""
    return arm_rows.name_arm(row["arm"]), families.word(row["regulator"]), row["substeps"]


def describe_episodes(row: pd.Series) -> tuple:
    """Return the cells of a loop's episodes and delays."""
    delays = [round(1e6 * row[f"delay_{name}_s"]) for name in STATISTICS]
    return *name_loop(row), row["starts"], row["settled"], row["simulated"], row["agreeing"], *delays


def describe_gains(row: pd.Series) -> tuple:
    """Return the cells of a loop's largest stable Kv, measured and predicted."""
    return (
        *name_loop(row),
        *map(round, row[["kv_measured", "kv_predicted", "kv_replayed", "kv_replay_predicted"]]),
    )


@responsive_picture
def limits(study: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw the greatest stable Kv T against the delay: theory as curves, the loops in real time as points."""
    figure, axes = style.panels(height=3.0, narrow=narrow)
    is_shown = DELAYS <= SHOWN_DELAY
    alternating = np.array([find_alternating_limit(delay) for delay in DELAYS.tolist()])
    is_alternating = is_shown & np.isfinite(alternating)
    axes.plot(DELAYS[is_shown], constant_limits()[is_shown], color=style.INK, linestyle=style.SOLID)
    axes.plot(
        DELAYS[is_alternating],
        alternating[is_alternating],
        color=style.MUTED,
        linestyle=style.DASHED,
        linewidth=1.2,
    )
    delays, gains = study["delay_median_s"] / PERIOD_S, study["kv_measured"] * PERIOD_S
    colour = style.INK
    axes.plot(delays, gains, "o", markersize=4, markerfacecolor="none", markeredgecolor=colour)
    axes.set(xlim=(0.0, SHOWN_DELAY), ylim=(1.5, 3.5))
    axes.set(xlabel="delay [control periods]", ylabel="greatest stable Kv T")
    style.label_line(axes, 0.045, 2.02, "in real time", colour)
    style.label_line(axes, 0.195, 2.75, "calculated")
    style.label_line(axes, 0.16, 3.3, "eigenvalue −1", style.MUTED)
    delay, gain = find_greatest_limit()
    return figure, (
        "With a constant delay the greatest stable Kv T rises from "
        f"{find_constant_limit(0.0):.2f} without delay to {gain:.2f} at {delay:.3f} periods and "
        f"falls to {find_constant_limit(SHOWN_DELAY):.2f} at {SHOWN_DELAY:g}. The {len(study)} "
        f"loops in real time, at median delays of {delays.min():.3f} to {delays.max():.3f} "
        f"periods, lie at {gains.min():.2f} to {gains.max():.2f}."
    )
