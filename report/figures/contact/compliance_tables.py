"""Tables of the page on compliance: what each impedance's springs are like, what (3.12) keeps, what it is there for."""

from __future__ import annotations

import math
import sys

import numpy as np
import pandas as pd

from bench.contenders.registry import known_representations
from bench.findings.theory import compliance_theory as theory
from bench.law.so3 import from_quaternion
from report.figures.contact import compliance_rows
from report.figures.kit import html
from report.figures.kit.spelling import power
from tasks.rotations import zyx

BETAS = (0.0, 30.0, 60.0, 85.0)
LISTED = (0.0, 1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0, 90.0)
OFF_AT = 30.0
ORDER = "about x"
EPS = sys.float_info.epsilon


def springs(rows: pd.DataFrame) -> html.Markdown:
    """An impedance a line: condition number of its stiffness over beta, asymmetry, and how far its axes are off.

    Args:
        rows: of wrench-probe.
    """
    own = compliance_rows.level(rows[rows["way"].str.startswith("impedance-")])
    lines, betas = [], compliance_rows.nearest(own, BETAS)
    for way in compliance_rows.ways(own):
        mine = own[own["way"] == way].groupby("beta_deg")
        condition, axes = mine["stiffness_condition"].max(), mine["stiffness_axes_rad"].max()
        lines.append(
            {
                "Error of orientation": compliance_rows.title(way).removeprefix(compliance_rows.SPRINGS),
                **{f"κ at β = {beta:.0f}°": condition.get(beta, math.nan) for beta in betas},
                f"Axes off at {OFF_AT:.0f}° [deg]": math.degrees(axes.get(OFF_AT, math.nan)),
                "Asymmetry": float(mine["stiffness_asymmetry"].max().max()),
            }
        )
    frame = pd.DataFrame(lines)
    forms = {name: ".2f" if "κ at" in name else ".1f" for name in frame if "κ" in name or "off" in name}
    return html.table(frame, {**forms, "Asymmetry": power, f"κ at β = {betas[-1]:.0f}°": html.number})


def conversion(rows: pd.DataFrame) -> html.Markdown:
    """A beta a line: what (3.12) does with moments, and what happens without it, complying about x.

    Args:
        rows: of wrench-probe.
    """
    own = compliance_rows.level(rows[rows["complies"] == ORDER])
    both = {name: compliance_rows.of(own, name) for name in (compliance_rows.EULER, compliance_rows.UNCONVERTED)}
    lines = []
    for beta in compliance_rows.nearest(own, LISTED):
        at = {name: mine[mine["beta_deg"] == beta] for name, mine in both.items()}
        line: dict = {"β [deg]": f"{beta:.0f}"}
        for name, word in zip(both, ("converted", "unconverted"), strict=True):
            mine = at[name]
            full = mine["arm"].map({arm: compliance_rows.wanted(rows, arm) for arm in compliance_rows.arms(rows)})
            line |= {
                f"Turn, {word} [%]": 100.0 * float((mine["c_xx"] / full.astype(float)).median()),
                f"Work lost, {word}": float(mine["work_residual"].max()),
                f"Ends, {word}": endings(mine),
            }
        lines.append(line)
    frame = pd.DataFrame(lines)
    forms = {name: ".1f" if name.startswith("Turn") else lost for name in frame if name[:4] in ("Turn", "Work")}
    return html.table(frame, forms, words=("β [deg]",))


def lost(value: float) -> str:
    """A residual of work: rounding in eps, more as a number."""
    return f"{value / EPS:.1f} eps" if value < 1e3 * EPS else f"{value:.2g}"


def endings(rows: pd.DataFrame) -> str:
    """How the rows end, in words; none if they all reach the end."""
    failed = [word for word in dict.fromkeys(rows["outcome"]) if word != "done"]
    return ", ".join(failed) or "done"


def facts(rows: pd.DataFrame) -> dict[str, str]:
    """Numbers for the page: work in the loop, and the moment that a pole of Z-Y-X angles loses."""
    representation = known_representations()["zyx-euler"]
    axis, kept = theory.lost_moment(representation, from_quaternion(zyx(0.0, math.pi / 2.0, 0.0)))
    euler = rows[rows["way"].isin(("hybrid/zyx-euler", compliance_rows.SPRINGS_OF_EULER))]
    done = euler["work_residual"].dropna()
    unconverted = compliance_rows.of(rows, compliance_rows.UNCONVERTED)["work_residual"]
    return {
        "work_n": str(len(done)),
        "work_eps": f"{done.max() / EPS:.1f}",
        "work_bad": html.number(float(unconverted.max())),
        "lost_axis": "xyz"[int(np.argmax(np.abs(axis)))],
        "lost_kept": f"{kept:.0e}" if kept else "0",
    }
