"""Tasks in contact by controller and frame of the hand: what each is measured by, drawn."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pandas as pd

from report.figures.contact import rows as controllers
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

DEGREES, MILLI = 180.0 / np.pi, 1e3


class Measure(NamedTuple):
    """A column of compliance.parquet as it is drawn: its words, short ones, unit there and factor to it, a format.

    middle: what stands for several episodes, "median", or "mean" of what is counted.
    failed: what an episode counts as that fails before it has a value: the worst there is.
    """

    column: str
    title: str
    short: str
    unit: str
    factor: float = 1.0
    form: str = ".2f"
    middle: str = "median"
    failed: float = np.inf

    def over_beta(self, rows: pd.DataFrame) -> pd.Series:
        """One value for each beta [deg] of the rows, NaN where at least half of the episodes failed."""
        values = (rows[self.column] * self.factor).fillna(self.failed)
        middles = values.groupby(rows["beta_deg"]).agg(self.middle)
        return middles.where(np.isfinite(middles))


MEASURES = {
    "surface-alignment": (
        Measure("alignment_error_rad", "Tool to plate at the end", "Off the plate", "deg", DEGREES),
        Measure("held_turn_rad", "Turned about the held axis", "Yaw", "deg", DEGREES),
    ),
    "peg-in-hole": (
        Measure("insertion_depth_m", "Depth of insertion", "Depth", "mm", MILLI, ".1f", failed=-np.inf),
        Measure("jam", "Not in at the end", "Not in", "%", 100.0, ".0f", "mean", 100.0),
    ),
    "crank": (
        Measure("crank_angle_rad", "Turned by", "Turned", "deg", DEGREES, ".1f", failed=-np.inf),
        Measure("moment_error_rms_nm", "Moment where it complies, rms", "Moment", "N m"),
    ),
    "force-on-plane": (
        Measure("normal_force_error_n", "Normal force, rms error", "Force error", "N"),
        Measure("held_turn_rad", "Turned about held axes", "Turned", "deg", DEGREES),
    ),
}
"""Of each task the two numbers that say how it went, the tasks whose orders free turns first."""

DRAWN = (
    "hybrid-base+transpose",
    "hybrid/zyx-euler+transpose",
    "impedance-geometric",
    "impedance-coordinates/zyx-euler",
)
"""The paper's force control on both Jacobians, and springs."""

SHIFT = 0.022  # of the axis, between controllers that would hide each other


def tasks_of(rows: pd.DataFrame) -> list[str]:
    """The tasks that are here, in the order of MEASURES."""
    return [name for name in MEASURES if name in set(rows["task"])]


@responsive_picture
def by_frame(rows: pd.DataFrame, narrow: bool):
    """A row of panels a task, over the beta of the hand's frame; a line a controller, through the medians.

    Args:
        rows: of the tasks of MEASURES.
    """
    names = tasks_of(rows)
    figure, grid = style.panels(len(names), 2, height=2.15 * len(names) + 0.9, narrow=narrow, squeeze=False)
    words = []
    for name, pair in zip(names, grid, strict=True):
        own = rows[rows["task"] == name]
        for axes, measure in zip(pair, MEASURES[name], strict=True):
            words += _panel(axes, own, measure, narrow)
        pair[0].annotate(
            name.replace("-", " "), (0.0, 1.0), xytext=(0, 22), xycoords="axes fraction", textcoords="offset points",
            fontweight="bold", va="bottom",
        )  # fmt: skip
    for axes in grid[-1]:
        axes.set_xlabel("β of the hand's frame [deg]" if not narrow else "β [deg]")
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=1 if narrow else 2)
    return figure, f"How tasks in contact end, by controller and beta of the hand's frame; medians. {'; '.join(words)}."


def _panel(axes, own: pd.DataFrame, measure: Measure, narrow: bool) -> list[str]:
    betas, words = sorted(set(own["beta_deg"])), []
    width = (betas[-1] - betas[0]) or 1.0
    for k, contender in enumerate(DRAWN):
        mine = own[own["contender"] == contender]
        if mine.empty:
            continue
        way = contender.partition("+")[0]
        look = controllers.LOOKS[way]
        middle = measure.over_beta(mine)
        shift = width * SHIFT * (k - (len(DRAWN) - 1) / 2.0)
        drawn = axes.plot(middle.index + shift, middle, color=look.colour, linestyle=look.line)[0]
        drawn.set_label(controllers.title(way))
        if measure.middle == "mean":
            drawn.set(marker=look.marker, markersize=4.5)
        else:
            values = mine[measure.column] * measure.factor
            axes.plot(mine["beta_deg"] + shift, values, look.marker, color=look.colour, markersize=3.0, alpha=0.55)
        values_at = ", ".join(f"{value:{measure.form}} at {beta:.0f}" for beta, value in middle.items())
        words.append(
            f"{own['task'].iloc[0]}, {controllers.title(way)}, {measure.title.lower()} in {measure.unit}: {values_at}"
        )
    name = measure.short if narrow else measure.title
    axes.set_title(f"{name} [{measure.unit}]", fontweight="normal")
    axes.set_xticks(betas if len(betas) < 7 else betas[:: len(betas) // 4])
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    return words
