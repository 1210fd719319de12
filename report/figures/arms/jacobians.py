"""What the page on Euler angles says of arms: how J and the Euler Jacobian are conditioned, and the pole in motion."""

import math
from collections.abc import Iterator

import pandas as pd

from bench.experiments.suites import IDEAL_MOTORS
from bench.findings.claims.euler_jacobian import WELL_CONDITIONED
from bench.law.contenders.registry import papers_coordinates
from report.figures.arms import arm_rows
from report.figures.arms.arm_rows import name_arm
from report.figures.kit import html, media
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import power

PAPERS = papers_coordinates().name
LOST = 1e12
"""A condition number beyond which the rest is rounding: what a double holds, less four digits."""
BAD = 100.0
"""Condition number (metres, radians) from which on a Jacobian is called bad: twice what the claims allow."""
HAMMERED = 10.0
"""Peak torque over that of the law on R from the same start, as in claim C20: beyond it something hammers the arm."""
POLE = html.Table("Arm | Starts | Geometric, settled | Geometric, torque | Euler, settled | Euler, torque")
FIRST_EXAMPLE = {"representation": PAPERS, "pose_set": "named", "arm": "puma560", "pose_id": "qn"}
FILM = (
    "The same two motions side by side: the Euler Jacobian throws the arm about, the geometric one turns the tool in "
    "place."
)


def facts(run: Run) -> dict:
    """Return the first example, the poses that J_E spoils, the film, and what the pole does to each arm."""
    return {
        "first": in_run(lambda: describe_first(run.rows("poses", **FIRST_EXAMPLE))),
        "spoilt": in_run(lambda: count_spoilt(run.rows("poses", representation=PAPERS, pose_set="random"))),
        "pole-loop": media.loop(FILM),
        **describe_film(),
        **(in_run(lambda: count_at_pole(pass_pole(run))) or {}),
    }


def pass_pole(run: Run) -> pd.DataFrame:
    """Join starts whose turn passes the pole of Z-Y-X angles: a row a start by (3.7), with (2.2) on R beside it."""
    rows = arm_rows.with_standard(arm_rows.episodes(run, IDEAL_MOTORS))
    starts = rows[rows["start_set"] == "pole"]
    columns = ["arm", "start_id", "outcome", "peak_torque_ratio"]
    own, other = (
        starts.loc[starts["controller"] == name, columns] for name in (arm_rows.ON_ANGLES, arm_rows.ON_MATRIX)
    )
    both = own.merge(other, on=["arm", "start_id"], suffixes=("", "_matrix"))
    return both.assign(
        fails=both["outcome"] != "settled",
        fails_matrix=both["outcome_matrix"] != "settled",
        harder=both["peak_torque_ratio"] / both["peak_torque_ratio_matrix"],
    )


def count_at_pole(both: pd.DataFrame) -> dict:
    """Return how many starts fail, and how much more torque the Euler Jacobian needs; and a row an arm."""
    hammered = ~both["fails"] & (both["harder"] > HAMMERED)
    return {
        "pole": POLE(compare_at_pole(both)),
        "pole_n": len(both),
        "pole_fails": int(both["fails"].sum()),
        "pole_fails_m": int(both["fails_matrix"].sum()) or "none",
        "hammer": f"{HAMMERED:g}",
        "hammered": int(hammered.sum()),
        "harder": html.number(float(f"{both['harder'].median():.2g}")),
    }


def compare_at_pole(both: pd.DataFrame) -> Iterator[tuple]:
    """Return a row an arm."""
    for arm, own in both.groupby("arm"):
        cells = []
        for end in ("_matrix", ""):
            torque = float(f"{own[f'peak_torque_ratio{end}'].median():.2g}")
            cells += [f"{(~own[f'fails{end}']).sum()} of {len(own)}", torque]
        yield name_arm(arm), len(own), *cells


def describe_first(rows: pd.DataFrame) -> str:
    """Return both condition numbers and the pitch of a pose in words."""
    at = rows.iloc[0]
    of_angles = float(at["condition_analytic"])
    number = html.MISSING if math.isnan(of_angles) else power(of_angles) if of_angles > LOST else f"{of_angles:.1f}"
    return (
        f"the geometric Jacobian has condition number {at['condition']:.1f} and the Euler Jacobian {number}, because "
        f"the tool is at β = {math.degrees(at['beta']):.0f}°"
    )


def count_spoilt(rows: pd.DataFrame) -> str:
    """Return the least and greatest share of poses with a good J that J_E of Z-Y-X angles makes bad, in words."""
    fine = rows[rows["condition"] <= WELL_CONDITIONED]
    by = 100.0 * (fine["condition_analytic"] > BAD).groupby(fine["arm"].astype(str)).mean()
    return (
        f"We took poses where the geometric Jacobian has a condition number of at most {WELL_CONDITIONED:g}. In "
        f"{by.min():.1f} to {by.max():.1f} % of these poses, depending on the arm, the condition number of the Euler "
        f"Jacobian exceeds {BAD:g}."
    )


def describe_film() -> dict[str, str]:
    """Return the arm of the film, how much torque both controllers ask for, and how long a way one goes."""
    about = media.facts()
    euler, geometric = about["episodes"]
    return {
        "film_arm": name_arm(about["arm"]),
        "film_ratio": f"{euler['peak_torque_ratio']:.0f}",
        "film_ratio_geometric": f"{geometric['peak_torque_ratio']:.2f}",
        "film_path": f"{euler['path_ratio']:.1f}",
    }
