"""The page on compliance: what Euler angles make of a compliant hand, by theory and by a probe of moments."""

from __future__ import annotations

import math
import sys

import numpy as np
import pandas as pd

from bench.findings.selection.words import together
from bench.findings.theory import compliance_theory as theory
from bench.law.contenders.registry import contenders
from bench.law.so3 import from_quaternion
from report.figures.contact import by_transpose
from report.figures.contact import rows as controllers
from report.figures.contact.hand_axes import axes_of_turning, measured, shown_arm, turns
from report.figures.contact.misalignment_map import misalignment
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table
from tasks.rotations import zyx

PROBE = "wrench-probe"
LISTED = (0.0, 1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0, 90.0)
ORDER = "about x"
EPS = sys.float_info.epsilon


def lost_work(value: float) -> str:
    """Return a residual of work: rounding in eps, more as a number."""
    return f"{value / EPS:.1f} eps" if value < 1e3 * EPS else f"{value:.2g}"


CONVERSION = Table(
    "β [deg] | Turn, converted [%]:.1f | Work lost, converted | Ends, converted | Turn, unconverted [%]:.1f | "
    "Work lost, unconverted | Ends, unconverted",
    {"Work lost, converted": lost_work, "Work lost, unconverted": lost_work},
)


def facts(run: Run) -> dict:
    """Return the numbers of the probe."""
    return probed(controllers.of_task(run, PROBE))


def probed(rows: pd.DataFrame) -> dict:
    """Return the probe's numbers: theory, measurement, other controllers, work, and the moment that a pole loses."""
    axis, kept = theory.lost_moment(
        contenders("representations")["zyx-euler"], from_quaternion(zyx(0.0, math.pi / 2.0, 0.0))
    )
    work = rows.loc[rows["way"].isin(("hybrid/zyx-euler", controllers.SPRINGS_OF_EULER)), "work_residual"].dropna()
    return {
        "axes_arm": shown_arm(rows),
        **measured(turns(rows)),
        "off_by_accelerations": off_by_accelerations(rows),
        "probe_arms": together(controllers.arms(rows)),
        "probe_rows": len(rows),
        "cartesian": cartesian(rows),
        "work_n": str(len(work)),
        "work_eps": f"{work.max() / EPS:.1f}",
        **by_transpose.facts(rows),
        "lost_axis": "xyz"[int(np.argmax(np.abs(axis)))],
        "lost_kept": f"{kept:.0e}" if kept else "0",
    }


def off_by_accelerations(rows: pd.DataFrame) -> str:
    """Return how far the Euler hand's misalignment is from beta [deg], about x and y complying by accelerations."""
    own = controllers.level(controllers.of(rows, controllers.EULER, "about x and y"))
    own = own[own["outcome"] == "done"]
    return power(float((np.degrees(own["misalignment_rad"]) - own["beta_deg"].abs()).abs().max()))


def cartesian(rows: pd.DataFrame) -> str:
    """Return what Cartesian compliance leaves of the same errors, over every frame and order."""
    own = rows[rows["way"].isin(("hybrid-base", "hybrid-hand"))]
    done = int((own["outcome"] == "done").sum())
    return (
        f"Cartesian compliance, along the base's axes or the hand's, has none of it: {done} rows of {len(own)} reach "
        f"the end, and it leaks at most {power(own['leakage_ratio'].max())} and turns at most "
        f"{power(np.degrees(own['misalignment_rad'].max()))} degrees away from the moment. It computes no Euler "
        "angles, so that it has none of their singularities."
    )


def conversion(rows: pd.DataFrame) -> html.Markdown | None:
    """Return a beta a line: what (3.12) does with moments, and what happens without it, complying about x."""
    own, full = controllers.level(rows[rows["complies"] == ORDER]), controllers.wanted(rows)
    lines = []
    for beta in controllers.nearest(own, LISTED):
        line: list = [f"{beta:.0f}"]
        for name in (controllers.EULER, controllers.UNCONVERTED):
            mine = controllers.of(own[own["beta_deg"] == beta], name)
            turned = 100.0 * float((mine["c_xx"] / mine["arm"].map(full).astype(float)).median())
            failed = [word for word in dict.fromkeys(mine["outcome"]) if word != "done"]
            line += [turned, float(mine["work_residual"].max()), ", ".join(failed) or "done"]
        lines.append(line)
    return CONVERSION(lines)


def tables(run: Run) -> dict:
    """Return the conversion of moments, and verdicts."""
    return {
        "tab_conversion": conversion(controllers.of_task(run, PROBE)),
        "verdicts": controllers.verdicts(run, "C21", "C22", "C23", "C24"),
    }


def figures(run: Run) -> dict:
    """Return the axes of turning, and the map of frames."""
    probe = controllers.of_task(run, PROBE)
    return {
        "compliance-axes": axes_of_turning(probe),
        "compliance-map": misalignment(probe, (controllers.EULER, controllers.ZYZ)),
    }
