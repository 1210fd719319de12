"""What the page on arms says of Jacobians: how well J and the Euler Jacobian are conditioned, and the film (3.1)."""

from __future__ import annotations

import math

import pandas as pd

from bench.findings.claims.euler_jacobian import WELL_CONDITIONED
from bench.law.contenders.registry import papers_coordinates
from report.figures.arms.arm_rows import name_arm
from report.figures.kit import html, media
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import power

PAPERS = papers_coordinates().name
LOST = 1e12
"""A condition number beyond which the rest is rounding: what a double holds, less four digits."""
BAD = 100.0
"""Condition number (metres, radians) from which on a Jacobian is called bad: twice what the claims allow."""
FIRST_EXAMPLE = {"pose_set": "named", "arm": "puma560", "pose_id": "qn"}
FILM = (
    "The same two motions side by side: the Euler Jacobian throws the arm about, the geometric one turns the tool in "
    "place."
)


def papers(run: Run, **words: str) -> pd.DataFrame:
    """Poses seen in the paper's coordinates."""
    return run.rows("poses", representation=PAPERS, **words)


def facts(run: Run) -> dict:
    """Return the first example, the poses that J_E spoils, and the film."""
    of_poses = {
        "first": lambda: describe_first(papers(run, **FIRST_EXAMPLE)),
        "spoilt": lambda: count_spoilt(papers(run, pose_set="random")),
    }
    return describe_film() | {key: in_run(say) for key, say in of_poses.items()}


def figures(_: Run) -> dict:
    """Return the film."""
    return {"pole-loop": media.loop(FILM)}


def describe_first(rows: pd.DataFrame) -> str:
    """Return both condition numbers and the pitch of a pose in words."""
    at = rows.iloc[0]
    of_angles = float(at["condition_analytic"])
    number = html.MISSING if math.isnan(of_angles) else power(of_angles) if of_angles > LOST else f"{of_angles:.1f}"
    return (
        f"has a Jacobian with condition number {at['condition']:.1f}; in Z-Y-X angles it is {number}, for its tool "
        f"stands at β = {math.degrees(at['beta']):.0f}°, on the pole"
    )


def count_spoilt(rows: pd.DataFrame) -> str:
    """Return the least and greatest share of poses with a good J that J_E of Z-Y-X angles makes bad, in words."""
    fine = rows[rows["condition"] <= WELL_CONDITIONED]
    by = 100.0 * (fine["condition_analytic"] > BAD).groupby(fine["arm"].astype(str)).mean()
    return (
        f"Of the poses where J is in good condition (at most {WELL_CONDITIONED:g}), Z-Y-X angles spoil {by.min():.1f} "
        f"to {by.max():.1f} % (a condition number of J_E beyond {BAD:g})"
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
