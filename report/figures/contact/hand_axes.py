"""What Euler compliance does wrong, in one picture: the moment on a hand, and the axis that the hand then turns about.

The hand points down at beta = 0 and lies level at 90 degrees, with its own x axis in the plane of the picture. Each
curved arrow in colour is a measured row: the direction of C e, and its length over that of a hand that yields as set.
"""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.patches import FancyArrowPatch, Polygon
from scipy.spatial.transform import Rotation

from report.figures.contact.rows import PAPERS, PAPERS_EULER, compliance, level, nearest, of
from report.figures.kit import style
from report.figures.kit.inline import Drawing, responsive_picture

COLOURS = {PAPERS: "#0072b2", PAPERS_EULER: "#d55e00"}
NAMES = {PAPERS: "Cartesian", PAPERS_EULER: "Euler"}
BETAS = (0, 30, 60, 85)
ORDER = "about x and y"
PUSHED = {"x": "A moment about x,\nwhere it should comply", "z": "A moment about z,\nwhere it should hold"}
STILL = 0.01  # of the wanted rotation: less is drawn as none

AZIMUTH, ELEVATION = math.radians(-68.0), math.radians(16.0)
TOWARDS = np.array(
    [math.cos(AZIMUTH) * math.cos(ELEVATION), math.sin(AZIMUTH) * math.cos(ELEVATION), math.sin(ELEVATION)]
)  # from what is drawn to the eye
LENGTH, RADIUS = 1.12, 0.27  # of an axis' arrow, and of the ring around it; the hand is about 1 long
WINDOW = (-1.22, 1.22, -1.36, 1.22)  # left, right, below, above; words stand at its foot

SIGNS = np.array(list(itertools.product((-1, 1), repeat=3)))
FACES = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
"""Corners of a box, and which of them are a face."""
BOXES = (
    ((0.0, 0.0, 0.38), (0.10, 0.10, 0.20)),
    ((0.0, 0.0, 0.06), (0.34, 0.14, 0.13)),
    ((-0.25, 0.0, -0.30), (0.06, 0.10, 0.24)),
    ((0.25, 0.0, -0.30), (0.06, 0.10, 0.24)),
)
"""Middle and half edges of wrist, palm and two fingers in the hand's frame, at the middle of the palm."""


def eye(points: Any) -> np.ndarray:
    """N x 2, right and up on paper, of points in the base frame: parallel projection."""
    right = np.array([-math.sin(AZIMUTH), math.cos(AZIMUTH), 0.0])
    return np.atleast_2d(points) @ np.column_stack((right, np.cross(TOWARDS, right)))


def draw_hand(axes: Any, beta: float) -> None:
    """Draw the hand at Ry(beta), beta in degrees, its far faces first."""
    corners = [np.array(middle) + half * SIGNS for middle, half in BOXES]
    faces = [Rotation.from_euler("y", beta, degrees=True).apply(one[list(face)]) for one in corners for face in FACES]
    look: dict[str, Any] = {"facecolor": style.GRID, "edgecolor": style.MUTED, "linewidth": 0.6, "zorder": 2}
    for face in sorted(faces, key=lambda one: float(np.mean(one @ TOWARDS))):
        axes.add_patch(Polygon(eye(face), closed=True, **look))


def draw_turn(
    axes: Any, direction: Any, size: float, colour: str, zorder: float, width: float, dashes: Any = "-"
) -> None:
    """Draw an axis through the hand, and a ring with a head around it; both shrink with the size, 0 to 1."""
    direction = np.asarray(direction) / np.linalg.norm(direction)
    reach = LENGTH * (0.4 + 0.6 * size)
    ends = eye([-0.85 * reach * direction, reach * direction])
    axes.plot(*ends.T, color=colour, linewidth=width, zorder=zorder, linestyle=dashes)
    first = np.cross(direction, TOWARDS)
    first /= np.linalg.norm(first)
    angles = np.linspace(-0.35 * math.pi, 1.3 * math.pi, 60)  # the gap is behind
    around = np.outer(np.cos(angles), first) + np.outer(np.sin(angles), np.cross(direction, first))
    path = eye(0.8 * reach * direction + RADIUS * (0.5 + 0.5 * size) * around)
    axes.plot(*path[:-5].T, color=colour, linewidth=max(width, 1.6), zorder=zorder)
    head: dict[str, Any] = {
        "mutation_scale": 11,
        "color": colour,
        "linewidth": 0,
        "shrinkA": 0,
        "shrinkB": 0,
        "zorder": zorder,
    }
    axes.add_patch(FancyArrowPatch(path[-9], path[-1], arrowstyle="-|>", **head))


def draw_frame(axes: Any) -> None:
    """Draw the base's axes, small, in a corner."""
    at = np.array([-1.02, 0.0, -0.95])
    corner = eye(at)[0]
    for axis, name in zip(np.eye(3), "xyz", strict=True):
        tip = eye(at + 0.34 * axis)[0]
        look: dict[str, Any] = {"arrowstyle": "-|>", "mutation_scale": 5, "color": style.MUTED, "linewidth": 0.9}
        axes.add_patch(FancyArrowPatch(corner, tip, **look))
        axes.text(*(corner + 1.35 * (tip - corner)), name, color=style.MUTED, fontsize=8.5, ha="center", va="center")


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
    betas = nearest(of(own, PAPERS_EULER, ORDER), BETAS)
    for contender, beta in [(PAPERS, betas[-2]), *((PAPERS_EULER, beta) for beta in betas)]:
        at = of(own, contender, ORDER)
        C = compliance(at[at["beta_deg"] == beta].iloc[0])
        for pushed in PUSHED:
            k = "xyz".index(pushed)
            turn = C[:, k]
            size = float(np.linalg.norm(turn))
            off = math.degrees(math.atan2(float(np.linalg.norm(np.delete(turn, k))), abs(float(turn[k]))))
            one = {"contender": contender, "beta": beta, "pushed": pushed, "axis": turn, "share": size / full}
            found.append({**one, "off": off if size > STILL * full else math.nan})
    return found


def measured(found: list[dict]) -> dict[str, str]:
    """How far off the moment the Euler hand turns at each tilt, and how far about the axis that it should hold.

    Args:
        found: of `turns`.
    """
    tilted = [one for one in found if one["contender"] == PAPERS_EULER and one["beta"] > 0.0]
    off = {one["beta"]: one["off"] for one in tilted if one["pushed"] == "x"}
    held = {one["beta"]: 100.0 * one["share"] for one in tilted if one["pushed"] == "z"}
    plain = [100.0 * one["share"] for one in found if one["contender"] == PAPERS and one["pushed"] == "z"]
    return {
        "off": ", ".join(f"{value:.0f}° at β = {beta:.0f}°" for beta, value in off.items()),
        "off_word": "less than β" if all(value < beta for beta, value in off.items()) else "not always less than β",
        "held": ", ".join(f"{value:.0f} % at β = {beta:.0f}°" for beta, value in held.items()),
        "held_cartesian": f"{max(plain):.0f} %",
    }


@responsive_picture
def axes_of_turning(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Return a row a moment, a column a controller and beta; on a phone a column a moment.

    Args:
        rows: of wrench-probe.
    """
    found = turns(rows)
    count = len(found) // len(PUSHED)
    shape = (count, len(PUSHED)) if narrow else (len(PUSHED), count)
    height = (1.95 if narrow else 1.72) * shape[0] + 0.3
    figure, grid = style.panels(*shape, height=height, narrow=narrow, squeeze=False)
    said = []
    for which, one in enumerate(found):
        k, i = divmod(which, len(PUSHED))
        axes, name = grid[k][i] if narrow else grid[i][k], NAMES[one["contender"]]
        does = draw_panel(axes, one)
        if i == 0:
            tilt = "any β" if one["contender"] == PAPERS else f"β = {one['beta']:.0f}°"
            axes.set_title(f"{name}, {tilt}", color=COLOURS[one["contender"]])
        if k == 0:
            words, look = PUSHED[one["pushed"]], {"fontsize": 9.5, "fontweight": "bold"}
            if narrow:
                place = {"xytext": (0, 26), "xycoords": "axes fraction", "textcoords": "offset points"}
                axes.annotate(words, (0.5, 1.0), ha="center", va="bottom", **place, **look)
            else:
                axes.set_ylabel(words, labelpad=6, **look)
        said.append(f"{name}, beta {one['beta']:.0f} degrees, moment about {one['pushed']}: {does}")
    return figure, (
        "Drawings of a robot's hand that complies with moments about x and y and is stiff against moments about z. "
        f"{'; '.join(said)}."
    )


def draw_panel(axes: Any, one: dict) -> str:
    """Draw one hand; return what it does, in words."""
    axes.set(xlim=WINDOW[:2], ylim=WINDOW[2:], aspect="equal", xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    draw_hand(axes, one["beta"])
    draw_frame(axes)
    moment = np.eye(3)["xyz".index(one["pushed"])]
    draw_turn(axes, moment, 1.0, style.INK, 5.0, 1.1, style.DASHED)
    colour, words = COLOURS[one["contender"]], "stays" if one["pushed"] == "z" else "does not turn"
    if not math.isnan(one["off"]):
        direction = one["axis"] * math.copysign(1.0, one["axis"] @ moment)
        draw_turn(axes, direction, min(one["share"], 1.0), colour, 4.0, 2.8)
        words = f"{one['off']:.0f}° off, {100 * one['share']:.0f} %"
    look = {"color": colour, "fontsize": 10, "fontweight": "bold", "ha": "center", "va": "bottom"}
    axes.text(0.5, 0.0, words, transform=axes.transAxes, **look)
    return words
