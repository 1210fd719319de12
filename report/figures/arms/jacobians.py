"""What the page on Jacobians shows: how well J and each J_E are conditioned, and what that does to an arm (3.1)."""

from __future__ import annotations

import math

import pandas as pd

from bench.findings.claims.euler_jacobian import WELL_CONDITIONED
from bench.law.contenders.registry import papers_coordinates
from report.figures.arms import arm_looks, condition_maps
from report.figures.kit import html, media
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import power

PAPERS = papers_coordinates().name
LOST = 1e12
"""A condition number beyond which the rest is rounding: what a double holds, less four digits."""
FIRST_EXAMPLE = {"pose_set": "named", "arm": "puma560", "pose_id": "qn"}
FILM = (
    "The same two motions side by side: the Euler Jacobian throws the arm about, the geometric one turns the tool in "
    "place."
)


def condition(value: float) -> str:
    """Return a condition number; one beyond all digits by its power alone."""
    return html.MISSING if math.isnan(value) else (power(value) if value > LOST else f"{value:.1f}")


def papers(run: Run, **words: str) -> pd.DataFrame:
    """Poses seen in the paper's coordinates."""
    return run.rows("poses", representation=PAPERS, **words)


def facts(run: Run) -> dict:
    """Return the first example, poses that J_E spoils, how far derivations are apart, and the film."""
    return filmed() | (in_run(lambda: of_poses(run)) or {})


def of_poses(run: Run) -> dict:
    """Return what the run's poses say."""
    every, slices = papers(run), papers(run, pose_set="slice")
    return {
        **first_example(papers(run, **FIRST_EXAMPLE)),
        **most_spoilt(papers(run, pose_set="random")),
        "joints": joints(slices),
        "bad": f"{condition_maps.BAD:g}",
        "well": f"{WELL_CONDITIONED:g}",
        "poses": f"{len(every):,}".replace(",", "\u202f"),
    }


def figures(run: Run) -> dict:
    """Draw the maps of two joints, and the film."""
    return {
        "condition-maps": in_run(lambda: condition_maps.maps(papers(run, pose_set="slice"))),
        "pole-loop": media.loop(FILM),
    }


def first_example(rows: pd.DataFrame) -> dict[str, str]:
    """Return the first example in words: beta, cond J, and cond J_E."""
    at = rows.iloc[0]
    return {
        "qn_beta": f"{math.degrees(at['beta']):.0f}°",
        "qn_J": f"{at['condition']:.1f}",
        "qn_zyx": condition(float(at["condition_analytic"])),
    }


def most_spoilt(rows: pd.DataFrame) -> dict[str, str]:
    """Return the least and greatest share of poses with a good J that J_E of Z-Y-X angles makes bad."""
    fine = rows[rows["condition"] <= WELL_CONDITIONED]
    by = (fine["condition_analytic"] > condition_maps.BAD).groupby(fine["arm"].astype(str)).mean()
    least, most = (f"{share:.1%}".replace("%", "\N{NO-BREAK SPACE}%") for share in (by.min(), by.max()))
    return {"spoilt_least": least, "spoilt_most": most}


def joints(rows: pd.DataFrame) -> str:
    """Return the joints of each slice and its number of poses, for a caption."""
    grids = {name: condition_maps.Grid(rows[rows["arm"] == name]) for name in arm_looks.arms(rows)}
    parts = [f"{arm_looks.title(name)}: joints {own.first} and {own.second}" for name, own in grids.items()]
    return f"{'; '.join(parts)} ({rows.groupby('arm', observed=True)['pose_id'].nunique().max()} poses each)"


def filmed() -> dict[str, str]:
    """How far off both controllers of the film are, how much torque they ask for, how long a way they go."""
    about = media.facts()
    euler, geometric = about["episodes"]
    return {
        "film_arm": arm_looks.title(about["arm"]),
        "film_ratio": f"{euler['peak_torque_ratio']:.0f}",
        "film_ratio_geometric": f"{geometric['peak_torque_ratio']:.2f}",
        "film_path": f"{euler['path_ratio']:.1f}",
        "film_off": f"{100 * euler['position_error_m']:.0f}",
        "film_off_geometric": f"{1000 * geometric['position_error_m']:.1f}",
        "film_miss": miss(about["start"]),
    }


def miss(start: str) -> str:
    """How near the pole a start's turn leads: pole-minus-1-k3 misses it by 10^-3 rad."""
    how = start.rpartition("-")[2]
    return "through the pole itself" if how == "exact" else f"past the pole at {power(10.0 ** -int(how[1:]))} rad"
