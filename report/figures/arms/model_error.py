"""When the plant is not the controller's model: how far from the goal the tool ends, by variation, arm, controller."""

from __future__ import annotations

import numpy as np
import pandas as pd

import tasks
from report.figures.arms import arm_rows
from report.figures.failures.failure_tables import outcomes
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture

SHOWN = (arm_rows.ON_MATRIX, arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)
QUANTILES = (0.05, 0.5, 0.95)
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
MARKERS = ("o", "s", "^", "D", "v", "P")
FLOOR_DEG, FLOOR_MM = 1e-3, 1e-2


def compared(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows by the controllers that settle every clear start of a perfect model, so that what is left is the model's.

    Args:
        rows: of `arm_rows.varied`, by the standard inverse.
    """
    return rows[rows["controller"].isin(SHOWN)]


def in_order(rows: pd.DataFrame) -> list[str]:
    """The variations that the rows hold, in the order of tasks/variations.py."""
    there = set(rows["variation"])
    return [name for name in tasks.variation_names() if name in there]


@responsive_picture
def spread(rows: pd.DataFrame, narrow: bool):
    """Angle and distance to the goal at the end, a row a variation, a mark an arm: median and 5 to 95 %.

    Args:
        rows: of `compared`.
    """
    words, names = in_order(rows), arm_rows.arms(rows)
    figure, (left, right) = style.panels(
        *((2, 1) if narrow else (1, 2)),
        height=0.46 * len(words) * (2 if narrow else 1) + 1.2,
        narrow=narrow,
        sharey=True,
    )
    said = []
    for i, word in enumerate(words):
        told = []
        for k, arm in enumerate(names):
            own = rows[(rows["variation"] == word) & (rows["arm"] == arm)]
            angle = np.degrees(own["final_angle_rad"]).clip(lower=FLOOR_DEG).quantile(QUANTILES)
            strays = (1e3 * own["position_error_m"]).clip(lower=FLOOR_MM).quantile(QUANTILES)
            place = i + 0.17 * (k - 0.5 * (len(names) - 1))
            for axes, (low, middle, high) in ((left, angle), (right, strays)):
                colour = COLOURS[k % len(COLOURS)]
                axes.plot([low, high], [place, place], color=colour, linewidth=2.2, alpha=0.5)
                axes.plot(middle, place, MARKERS[k % len(MARKERS)], color=colour, markersize=4.5)
            told.append(f"{arm} {angle[0.5]:.2g}")
        said.append(f"{word}: {', '.join(told)}")
    for k, arm in enumerate(names):
        left.plot([], [], MARKERS[k % len(MARKERS)], color=COLOURS[k % len(COLOURS)], label=arm)
    left.set(xscale="log", xlabel="angle to the goal at the end [deg]", ylim=(len(words) - 0.4, -0.6))
    right.set(xscale="log", xlabel="tool strays by [mm]")
    left.set_yticks(range(len(words)), words)
    for axes in (left, right):
        axes.grid(visible=False, axis="y")
        axes.tick_params(axis="y", length=0)
        axes.minorticks_off()
    figure.legend(loc="outside lower center", ncols=2 if narrow else 4)
    return figure, f"Median angle to the goal at the end in degrees. {'; '.join(said)}."


def table(rows: pd.DataFrame) -> html.Markdown:
    """A variation a row: what it is, episodes, share settled, how the others end, angle and distance.

    Args:
        rows: of `compared`.
    """
    lines = []
    for word in in_order(rows):
        own = rows[rows["variation"] == word]
        lines.append(
            {
                "Variation": html.together(f"`{word}`"),
                "The plant": tasks.variation(word).title,
                "Episodes": len(own),
                "Settled [%]": 100.0 * float(arm_rows.settled(own).mean()),
                "The others": html.together(outcomes(own)),
                "Angle [deg]": float(np.degrees(own["final_angle_rad"].median())),
                "Strays [mm]": 1e3 * float(own["position_error_m"].median()),
            }
        )
    return html.table(pd.DataFrame(lines), {"Settled [%]": ".0f", "Angle [deg]": ".2f", "Strays [mm]": ".1f"})


def by_controller(rows: pd.DataFrame) -> html.Markdown:
    """A controller and inverse a row: median angle at the end [deg] by kind of variation; arms of six joints or seven.

    Args:
        rows: of `arm_rows.varied`, every inverse.
    """
    kinds = rows["variation"].str.partition("-")[0]
    lines = []
    for controller in arm_rows.in_order(rows):
        own = rows[rows["controller"] == controller]
        for way, mine in own.groupby("way"):
            angle = np.degrees(mine["final_angle_rad"]).groupby(kinds[mine.index]).median()
            line = {
                "Controller": arm_rows.title(controller),
                "Inverse": arm_rows.title_of_inverse(str(way).partition("+")[2]),
                "Settled [%]": 100.0 * float(arm_rows.settled(mine).mean()),
            }
            lines.append(line | {f"{kind} [deg]": float(angle[kind]) for kind in dict.fromkeys(kinds) if kind in angle})
    frame = pd.DataFrame(lines)
    forms = {column: ".2f" for column in frame if str(column).endswith("[deg]")}
    return html.table(frame, {"Settled [%]": ".0f", **forms})
