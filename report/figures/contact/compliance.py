"""The page on compliance: what Euler angles make of a compliant hand, by theory and by a probe of moments."""

from __future__ import annotations

import functools
import math
import sys

import numpy as np
import pandas as pd

import tasks
from bench.findings.selection.words import together
from bench.findings.theory import compliance_theory as theory
from bench.findings.theory import hybrid_stability as stability
from bench.law.contenders.registry import known_representations
from bench.law.so3 import from_quaternion
from report.figures.contact import by_transpose, loops
from report.figures.contact import rows as controllers
from report.figures.contact.against_theory import COMPARED_TO, gaps
from report.figures.contact.hand_axes import axes_of_turning, measured, shown_arm, turns
from report.figures.contact.misalignment_map import misalignment
from report.figures.kit import html
from report.figures.kit.page import ABSENT, Run, given
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table
from tasks.rotations import zyx

PROBE, LOOP = "wrench-probe", "compliance-loop"
BETAS = (0.0, 30.0, 60.0, 85.0)
LISTED = (0.0, 1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0, 90.0)
NEAR_ZERO_DEG, OFF_AT = 15.0, 30.0
ORDER = "about x"
EPS = sys.float_info.epsilon
GIVEN_J = 1e-9
"""Energy from which on a row gives any: a millionth of what the probe's moment does on a hand that yields."""

POSES, SEED = 400, 0
SELECTIONS = {
    "z": (1, 1, 0, 1, 1, 1),
    "about x and y": (1, 1, 1, 0, 0, 1),
    "z, about x and y": (1, 1, 0, 0, 0, 1),
}
"""What complies -> what is held."""

SERVOS = {"alike": stability.even, "tuned": stability.tuned}
FORMS = {"J⁻¹ S": stability.ORIGINAL, "(S J)⁺": stability.PROJECTED}
"""Where Raibert and Craig's joint servos run away by themselves, over poses of an arm."""

UNSTABLE = Table(
    {"Arm": "", "Complies": "", **{f"{form}, servos {kind} [%]": ".1f" for form in FORMS for kind in SERVOS}}
)


def lost_work(value: float) -> str:
    """A residual of work: rounding in eps, more as a number."""
    return f"{value / EPS:.1f} eps" if value < 1e3 * EPS else f"{value:.2g}"


CONVERSION = Table(
    "β [deg] | Turn, converted [%]:.1f | Work lost, converted | Ends, converted | Turn, unconverted [%]:.1f | "
    "Work lost, unconverted | Ends, unconverted",
    {"Work lost, converted": lost_work, "Work lost, unconverted": lost_work},
)


def facts(run: Run) -> dict:
    """Return the numbers of the probe and of closed loops of moments."""
    return {
        **(given(controllers.of_task(run, PROBE), probed) or {}),
        **(given(controllers.of_task(run, LOOP), loops.facts) or {}),
        "forms_poses": POSES,
    }


def probed(rows: pd.DataFrame) -> dict:
    """Return the probe's numbers: theory, measurement, other controllers, work, and the moment that a pole loses."""
    axis, kept = theory.lost_moment(known_representations()["zyx-euler"], from_quaternion(zyx(0.0, math.pi / 2.0, 0.0)))
    work = rows.loc[rows["way"].isin(("hybrid/zyx-euler", controllers.SPRINGS_OF_EULER)), "work_residual"].dropna()
    return {
        "axes_arm": shown_arm(rows),
        **measured(turns(rows)),
        "off_by_accelerations": off_by_accelerations(rows),
        "passive": passive(rows),
        "probe_arms": together(controllers.arms(rows)),
        "probe_rows": len(rows),
        "gap": f"{power(max(gaps(rows).values()))} of the value (up to {COMPARED_TO:g}°)",
        "cartesian": cartesian(rows),
        "zyz": zyz(rows),
        "forms": forms(rows),
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
    """What Cartesian compliance leaves of the same errors, over every frame and order."""
    own = rows[rows["way"].isin(("hybrid-base", "hybrid-hand"))]
    done = int((own["outcome"] == "done").sum())
    return (
        f"Cartesian compliance, along the base's axes or the hand's, has none of it: {done} rows of {len(own)} reach "
        f"the end, and it leaks at most {power(own['leakage_ratio'].max())} and turns at most "
        f"{power(np.degrees(own['misalignment_rad'].max()))} degrees away from the moment. It computes no Euler "
        "angles, so that it has none of their singularities."
    )


def zyz(rows: pd.DataFrame) -> str:
    """What Z-Y-Z angles make of compliance about x near zero."""
    own = controllers.level(controllers.of(rows, controllers.ZYZ, "about x"))
    near = own[own["beta_deg"].abs() <= NEAR_ZERO_DEG]
    if near.empty:
        return f"Rows of Z-Y-Z angles are {ABSENT}."
    share = 100.0 * near["c_xx"] / near["arm"].map(controllers.wanted(rows)).astype(float)
    around = share[near["beta_deg"] != 0.0]
    words = (
        f"within {NEAR_ZERO_DEG:g} degrees of zero a moment about x turns the hand about x by {power(around.min())} to "
        f"{power(around.max())} % of what it should."
    )
    ends = [
        f"{one.arm}: {power(share[one.Index])} %" if one.outcome == "done" else f"{one.arm}: {one.outcome}"
        for one in near[near["beta_deg"] == 0.0].itertuples()
    ]
    if not ends:
        return words
    return f"{words} At zero itself, on their singularity, rounding decides: {'; '.join(ends)}."


def passive(rows: pd.DataFrame) -> str:
    """Which controllers give energy to what pushes a hand that begins at rest and without an order to exert any."""
    done = rows[rows["outcome"] == "done"]
    gives = done[done["port_energy_peak_j"] > GIVEN_J]
    plain, unconverted = (gives[gives["way"].str.contains("unconverted") == word] for word in (False, True))
    of_these = int(done["way"].str.contains("unconverted").sum())
    words = (
        f"A passive hand cannot give energy to what pushes it from rest. Unconverted it does in {len(unconverted)} of "
        f"{of_these} rows"
    )
    if plain.empty:
        return f"{words}; no other controller does in any of {len(done) - of_these}."
    near = " and the ".join(sorted({controllers.title(way) for way in plain["way"]}))
    return (
        f"{words}. Of the {len(done) - of_these} rows of other controllers {len(plain)} give energy, by at most "
        f"{power(plain['port_energy_peak_j'].max())} J: those of the {near}."
    )


def forms(rows: pd.DataFrame) -> str:
    """Whether the two resolutions to the joints differ where nothing is touched."""
    keys = ["arm", "way", "pose"]
    pair = rows[rows["form"] == "inverse"].merge(rows[rows["form"] == "projected"], on=keys)
    pair = pair[(pair["outcome_x"] == "done") & (pair["outcome_y"] == "done")]
    if pair.empty:
        return f"Rows of both ways are {ABSENT}."
    names = [f"c_{i}{j}" for i in "xyz" for j in "xyz"]
    one, other = (pair[[f"{name}_{side}" for name in names]].to_numpy() for side in "xy")
    apart = np.linalg.norm(one - other, axis=1) / np.linalg.norm(one, axis=1)
    return f"Over {len(pair)} pairs of rows that differ in nothing else, C is the same to {power(apart.max())}."


def tables(run: Run) -> dict:
    """Stability, springs, conversion of moments, verdicts."""
    return {
        "tab_forms": UNSTABLE(unstable()),
        "tab_transpose": given(controllers.of_task(run, PROBE), by_transpose.table),
        "tab_springs": given(controllers.of_task(run, PROBE), springs),
        "tab_conversion": given(controllers.of_task(run, PROBE), conversion),
        "verdicts": controllers.verdicts(run, "C21", "C22", "C23", "C24"),
    }


@functools.cache
def unstable() -> list[tuple]:
    """Share of poses at which the arm runs away [%]: a line an arm and selection, a column a form and kind of servo."""
    lines = []
    for name in ("puma560", "ur5e"):  # of six joints: J^-1 S is not written for more
        at = stability.poses(tasks.arm(name), POSES, SEED)
        for complies, held in SELECTIONS.items():
            shares = (
                100.0 * stability.unstable_share(at, held, form, servos)
                for form in FORMS.values()
                for servos in SERVOS.values()
            )
            lines.append((name, complies, *shares))
    return lines


def springs(rows: pd.DataFrame) -> html.Markdown | None:
    """An impedance a line: condition number of its stiffness over beta, asymmetry, and how far its axes are off."""
    own = controllers.level(rows[rows["way"].str.startswith("impedance-")])
    lines, betas = [], controllers.nearest(own, BETAS)
    for way in controllers.ways(own):
        mine = own[own["way"] == way].groupby("beta_deg")
        condition, axes = mine["stiffness_condition"].max(), mine["stiffness_axes_rad"].max()
        off = math.degrees(axes.get(OFF_AT, math.nan))
        asymmetry = float(mine["stiffness_asymmetry"].max().max())
        words = controllers.title(way).removeprefix(controllers.SPRINGS)
        lines.append((words, *(condition.get(beta, math.nan) for beta in betas), off, asymmetry))
    heads = {f"κ at β = {beta:.0f}°": html.number if beta == betas[-1] else ".2f" for beta in betas}
    return Table({"Error of orientation": "", **heads, f"Axes off at {OFF_AT:.0f}° [deg]": ".1f", "Asymmetry": power})(
        lines
    )


def conversion(rows: pd.DataFrame) -> html.Markdown | None:
    """A beta a line: what (3.12) does with moments, and what happens without it, complying about x."""
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


def figures(run: Run) -> dict:
    """Axes of turning, and the map of frames."""
    probe = controllers.of_task(run, PROBE)
    return {
        "compliance-axes": given(probe, axes_of_turning),
        "compliance-map": given(probe, lambda rows: misalignment(rows, (controllers.EULER, controllers.ZYZ))),
    }
