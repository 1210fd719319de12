"""The poses that have a name: how well J and each J_E are conditioned there (Murphy 1988, 3.1)."""

from __future__ import annotations

import math

import pandas as pd

from bench.contenders.registry import known_representations
from report.figures.arms import arm_poses
from report.figures.kit import html
from report.figures.kit.spelling import power

LOST = 1e12
"""A condition number beyond which the rest is rounding: what a double holds, less four digits."""


def conditions(rows: pd.DataFrame) -> html.Markdown:
    """A row a named pose: beta, cond J, and cond J_E in every representation."""
    lines = []
    for arm in arm_poses.arms(rows):
        own = rows[rows["arm"] == arm]
        for pose, at in own.groupby("pose_id", observed=True, sort=False):
            by = at.set_index(at["representation"].astype(str))
            line = {
                "Arm": arm_poses.title(arm),
                "Pose": f"`{pose}`",
                "β [deg]": round(math.degrees(at["beta"].iloc[0]), 1) + 0.0,
                "J": float(at["condition"].iloc[0]),
            }
            for name in known_representations():
                if name in by.index:
                    line[arm_poses.short_title(name)] = float(by.at[name, "condition_analytic"])
            lines.append(line)
    if not lines:
        return html.Markdown(f"| Poses |\n| :-- |\n| {arm_poses.NOT_HERE} |")
    frame = pd.DataFrame(lines)
    numbers = dict.fromkeys(frame.columns.drop(["Arm", "Pose"]), said)
    return html.table(frame, numbers | {"β [deg]": ".1f"})


def said(value: float) -> str:
    """A condition number; one beyond all digits by its power alone."""
    return html.MISSING if math.isnan(value) else (power(value) if value > LOST else f"{value:.1f}")


def stock(rows: pd.DataFrame, arm: str = "puma560", pose: str = "qn") -> dict[str, str]:
    """The first example in words: beta, cond J, cond J_E by Z-Y-X, and by the quaternion."""
    own = rows[(rows["arm"] == arm) & (rows["pose_id"] == pose)]
    by = own.set_index(own["representation"].astype(str))["condition_analytic"]
    if own.empty:
        return dict.fromkeys(("qn_beta", "qn_J", "qn_zyx", "qn_quaternion", "qn_mrp"), html.MISSING)
    return {
        "qn_beta": f"{math.degrees(own['beta'].iloc[0]):.0f}°",
        "qn_J": f"{own['condition'].iloc[0]:.1f}",
        "qn_zyx": said(float(by["zyx-euler"])),
        "qn_quaternion": said(float(by["quaternion"])),
        "qn_mrp": said(float(by["mrp"])),
    }
