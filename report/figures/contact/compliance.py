"""The page on compliance: the axis about which a hand yields, by the paper's force control and by accelerations.

In the picture the hand points down at beta = 0 and lies level at 90 degrees, with its own x axis in the plane of the
picture. Each ring in colour is a measured row: the direction of C e, and its length over that of a hand that yields as
set.
"""

import itertools
import math
from typing import Any

import numpy as np
import pandas as pd
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from scipy.spatial.transform import Rotation

from bench.findings.claims.side_by_side import compliances
from report.figures.arms.arm_rows import name_arm
from report.figures.contact import as_arms_run
from report.figures.contact.in_contact import EULER, PAPERS, PAPERS_EULER, level, of, of_task
from report.figures.kit import style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import power

PROBE = "wrench-probe"
COLOURS = {PAPERS: style.CARTESIAN, PAPERS_EULER: style.EULER}
NAMES = {PAPERS: "Cartesian", PAPERS_EULER: "Euler"}
BETAS = (0, 30, 60, 85)
ORDER = "about x and y"
PUSHED = {"x": "A moment about x,\nwhere it should comply", "z": "A moment about z,\nwhere it should hold"}
STILL = 0.01  # of the wanted rotation: less is drawn as none
BOLD: dict[str, Any] = {"fontsize": 9.5, "fontweight": "bold", "ha": "center", "va": "bottom"}

ELEVATION_DEG, AZIMUTH_DEG = 16.0, -68.0
EYE = Rotation.from_euler("yz", (-ELEVATION_DEG, AZIMUTH_DEG), degrees=True).apply((1.0, 0.0, 0.0))
FACES = np.array([(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)])
CORNERS = np.array([*itertools.product((-1, 1), repeat=3)])[FACES]
WRIST, PALM = ((0.0, 0.0, 0.38), (0.10, 0.10, 0.20)), ((0.0, 0.0, 0.06), (0.34, 0.14, 0.13))
FINGERS = [((x, 0.0, -0.30), (0.06, 0.10, 0.24)) for x in (-0.25, 0.25)]
"""Middle and half edges of boxes in the hand's frame, at the middle of the palm."""


def facts(run: Run) -> dict:
    """Return the numbers of the probe, the damping that two designs give an impedance, and the axes of turning."""
    rows = of_task(run, PROBE)
    damping, own = in_run(as_arms_run.facts, run) or {}, level(of(rows, EULER, ORDER))
    own = own[own["outcome"] == "done"]  # its misalignment by accelerations is beta
    return {
        "axes_arm": name_arm(shown_arm(rows)),
        **measured(turns(rows)),
        "off_by_accelerations": power(float((np.degrees(own["misalignment_rad"]) - own["beta_deg"].abs()).abs().max())),
        **{name: damping[name] for name in ("felt_least", "felt_most", "double") if name in damping},
        "compliance-axes": axes_of_turning(rows),
    }


def shown_arm(rows: pd.DataFrame) -> str:
    """Return the UR5e if it is there: its inertia, through which moments act, hardly couples x and z at home."""
    return max(rows["arm"])


def turns(rows: pd.DataFrame) -> list[dict]:
    """Return what is drawn of one arm: a Cartesian panel and one of Euler angles for each beta, by moment.

    A dictionary: contender, beta [deg], pushed ("x" or "z"), axis (3) that it turns about, share of the wanted
    rotation, off [deg] from the moment (NaN if it does not turn).
    """
    found = []
    own = level(rows[rows["arm"] == shown_arm(rows)])
    full = float(of(own, PAPERS, ORDER)["c_xx"].median())
    there = sorted(set(of(own, PAPERS_EULER, ORDER)["beta_deg"]))  # grids of suites differ: the nearest are taken
    betas = list(dict.fromkeys(min(there, key=lambda one: abs(one - beta)) for beta in BETAS))
    for contender, beta in [(PAPERS, betas[-2]), *((PAPERS_EULER, beta) for beta in betas)]:
        at = of(own, contender, ORDER)
        C = compliances(at[at["beta_deg"] == beta])[0]
        for pushed, turn in zip(PUSHED, (C[:, 0], C[:, 2]), strict=True):
            share, along = float(np.linalg.norm(turn)) / full, abs(turn @ unit(pushed))
            off = math.degrees(math.acos(min(along / (share * full), 1.0))) if share > STILL else math.nan
            one = {"contender": contender, "beta": beta, "pushed": pushed}
            found.append({**one, "axis": turn, "share": share, "off": off})
    return found


def unit(axis: str) -> np.ndarray:
    """Return the base axis x, y or z."""
    return np.eye(3)["xyz".index(axis)]


def measured(found: list[dict]) -> dict[str, str]:
    """Return how far off the moment the Euler hand of `turns` turns at each tilt, and how far about the held axis."""
    tilted = [one for one in found if one["contender"] == PAPERS_EULER and one["beta"] > 0.0]
    off = {one["beta"]: one["off"] for one in tilted if one["pushed"] == "x"}
    held = {one["beta"]: 100.0 * one["share"] for one in tilted if one["pushed"] == "z"}
    plain = [100.0 * one["share"] for one in found if one["contender"] == PAPERS and one["pushed"] == "z"]
    return {
        "off": ", ".join(f"{value:.0f}° at β = {beta:.0f}°" for beta, value in off.items()),
        "held": ", ".join(f"{value:.0f} % at β = {beta:.0f}°" for beta, value in held.items()),
        "held_cartesian": f"{max(plain):.0f} %",
    }


@responsive_picture
def axes_of_turning(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Return a row a moment, a column a controller and beta; on a phone a column a moment; rows: of wrench-probe."""
    found, said = turns(rows), []
    shape = (len(found) // 2, 2) if narrow else (2, len(found) // 2)
    view = {"projection": "3d", "proj_type": "ortho", "computed_zorder": False}
    height = (1.95 if narrow else 1.72) * shape[0] + 0.3
    figure, grid = style.panels(*shape, height=height, narrow=narrow, squeeze=False, subplot_kw=view)
    for which, (axes, one) in enumerate(zip((grid if narrow else grid.T).flat, found, strict=True)):
        name, place = NAMES[one["contender"]], (0.5, 1.22, 0) if narrow else (-0.12, 0.1, 90)
        tilt = "any β" if one["contender"] == PAPERS else f"β = {one['beta']:.0f}°"
        if one["pushed"] == "x":
            axes.set_title(f"{name}, {tilt}", color=COLOURS[one["contender"]])
        if which < len(PUSHED):
            axes.text2D(*place[:2], PUSHED[one["pushed"]], transform=axes.transAxes, rotation=place[2], **BOLD)
        said.append(f"{name}, beta {one['beta']:.0f} degrees, moment about {one['pushed']}: {draw_panel(axes, one)}")
    return figure, (
        "Drawings of a robot's hand that complies with moments about x and y and is stiff against moments about z. "
        f"{'; '.join(said)}."
    )


def draw_panel(axes: Any, one: dict) -> str:
    """Draw one hand, the base's axes, the moment and the axis turned about; return what it does, in words."""
    axes.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1.15, 0.85))
    axes.set_box_aspect((1, 1, 1), zoom=1.4)
    axes.view_init(elev=ELEVATION_DEG, azim=AZIMUTH_DEG)
    axes.axis("off")
    hand = Rotation.from_euler("y", one["beta"], degrees=True).as_matrix()
    faces = np.concatenate([(middle + half * CORNERS) @ hand.T for middle, half in (WRIST, PALM, *FINGERS)])
    axes.add_collection3d(Poly3DCollection(faces, facecolor=style.GRID, edgecolor=style.MUTED, linewidth=0.6, zorder=2))
    for axis in "xyz":
        corner = np.array((-1.0, 0.0, -0.95))
        axes.quiver(*corner, *(0.3 * unit(axis)), color=style.MUTED, linewidth=0.9, arrow_length_ratio=0.3)
        axes.text(*(corner + 0.42 * unit(axis)), axis, color=style.MUTED, fontsize=8.5, ha="center", va="center")
    moment, colour = unit(one["pushed"]), COLOURS[one["contender"]]
    draw_turn(axes, moment, 1.0, color=style.INK, zorder=5, linewidth=1.1, linestyle=style.DASHED)
    words = "stays" if one["pushed"] == "z" else "does not turn"
    if not math.isnan(one["off"]):
        direction = one["axis"] * math.copysign(1.0 / np.linalg.norm(one["axis"]), one["axis"] @ moment)
        draw_turn(axes, direction, min(one["share"], 1.0), color=colour, zorder=4, linewidth=2.8, linestyle="-")
        words = f"{one['off']:.0f}° off, {100 * one['share']:.0f} %"
    axes.text2D(0.5, -0.06, words, transform=axes.transAxes, color=colour, **BOLD)
    return words


def draw_turn(axes: Any, direction: np.ndarray, size: float, **look: Any) -> None:
    """Draw an axis through the hand, and a ring with a head around it; both shrink with the size, 0 to 1."""
    reach, radius = 1.12 * (0.4 + 0.6 * size), 0.27 * (0.5 + 0.5 * size)
    axes.plot(*np.outer(direction, (-0.85 * reach, reach)), **look)
    turned, _ = Rotation.align_vectors([direction, EYE], [(0, 0, 1), (0, -1, 0)], weights=[np.inf, 1.0])
    angles = np.r_[np.linspace(-0.35 * math.pi, 1.2 * math.pi, 60), np.array((1.2, 1.2, 1.5)) * math.pi]
    radii = radius * np.r_[np.ones(60), 0.3, 1.7, 1.0]  # the last three are the corners of the head
    points = np.column_stack((radii * np.cos(angles), radii * np.sin(angles), np.full(63, 0.8 * reach)))
    ring, head = np.split(turned.apply(points), [60])
    axes.plot(*ring.T, **{**look, "linestyle": "-", "linewidth": max(look["linewidth"], 1.6)})
    axes.add_collection3d(Poly3DCollection([head], facecolor=look["color"], zorder=look["zorder"]))
