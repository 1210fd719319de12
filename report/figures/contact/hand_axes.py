"""What Euler compliance does wrong, in one picture: the moment on a hand, and the axis that the hand then turns about.

The hand points down at beta = 0 and lies level at 90 degrees, with its own x axis in the plane of the picture. Each
curved arrow in colour is a measured row: the direction of C e, and its length over that of a hand that yields as set.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.patches import FancyArrowPatch, Polygon

from report.figures.contact.rows import PAPERS, PAPERS_EULER, compliance, level, nearest, of
from report.figures.kit import style
from report.figures.kit.inline import Drawing, responsive_picture

COLOURS = {PAPERS: "#0072b2", PAPERS_EULER: "#d55e00"}
BETAS = (0, 30, 60, 85)
ORDER = "about x and y"
PUSHED = (("x", "A moment about x, where it should comply"), ("z", "A moment about z, where it should hold"))
STILL = 0.01  # of the wanted rotation: less is drawn as none

AZIMUTH, ELEVATION = math.radians(-68.0), math.radians(16.0)
TOWARDS = np.array(
    [math.cos(AZIMUTH) * math.cos(ELEVATION), math.sin(AZIMUTH) * math.cos(ELEVATION), math.sin(ELEVATION)]
)  # from what is drawn to the eye
LENGTH, RADIUS = 1.12, 0.27  # of an axis' arrow, and of the ring around it; the hand is about 1 long
WINDOW = (-1.22, 1.22, -1.36, 1.22)  # left, right, below, above; words stand at its foot


def eye(points: Any) -> np.ndarray:
    """N x 2, right and up on paper, of points in the base frame: parallel projection."""
    right = np.array([-math.sin(AZIMUTH), math.cos(AZIMUTH), 0.0])
    return np.atleast_2d(points) @ np.column_stack((right, np.cross(TOWARDS, right)))


def depth(points: Any) -> float:
    """How near the middle of points is to the eye."""
    return float(np.mean(np.atleast_2d(points) @ TOWARDS))


def about_y(beta: float) -> np.ndarray:
    """Ry(beta) [rad]."""
    c, s = math.cos(beta), math.sin(beta)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def box(middle: Any, half: Any) -> list[np.ndarray]:
    """Return the six faces of a box along the axes, 4 x 3 each."""
    faces = []
    for axis in range(3):
        one, other = (k for k in range(3) if k != axis)
        for side in (-1, 1):
            corners = np.tile(np.array(middle, float), (4, 1))
            corners[:, axis] += side * half[axis]
            corners[:, one] += half[one] * np.array([-1, 1, 1, -1])
            corners[:, other] += half[other] * np.array([-1, -1, 1, 1])
            faces.append(corners)
    return faces


# Wrist, palm and two fingers in the hand's frame, which is at the middle of the palm; they point along -z of it.
HAND = [
    *box((0.0, 0.0, 0.38), (0.10, 0.10, 0.20)),
    *box((0.0, 0.0, 0.06), (0.34, 0.14, 0.13)),
    *box((-0.25, 0.0, -0.30), (0.06, 0.10, 0.24)),
    *box((0.25, 0.0, -0.30), (0.06, 0.10, 0.24)),
]


def draw_hand(axes: Any, beta: float) -> None:
    """Draw the hand at Ry(beta), its far faces first."""
    turned = [face @ about_y(beta).T for face in HAND]
    for face in sorted(turned, key=depth):
        axes.add_patch(
            Polygon(eye(face), closed=True, facecolor=style.GRID, edgecolor=style.MUTED, linewidth=0.6, zorder=2)
        )


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
    radius = RADIUS * (0.5 + 0.5 * size)
    ring = 0.8 * reach * direction + radius * (
        np.outer(np.cos(angles), first) + np.outer(np.sin(angles), np.cross(direction, first))
    )
    path = eye(ring)
    axes.plot(*path[:-5].T, color=colour, linewidth=max(width, 1.6), zorder=zorder)
    head: dict = {
        "arrowstyle": "-|>",
        "mutation_scale": 11,
        "color": colour,
        "linewidth": 0,
        "shrinkA": 0,
        "shrinkB": 0,
    }
    axes.add_patch(FancyArrowPatch(path[-9], path[-1], zorder=zorder, **head))


def draw_frame(axes: Any) -> None:
    """Draw the base's axes, small, in a corner."""
    at = np.array([-1.02, 0.0, -0.95])
    corner = eye(at)[0]
    for axis, name in zip(np.eye(3), "xyz", strict=True):
        tip = eye(at + 0.34 * axis)[0]
        axes.add_patch(
            FancyArrowPatch(corner, tip, arrowstyle="-|>", mutation_scale=5, color=style.MUTED, linewidth=0.9)
        )
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
        for pushed, _ in PUSHED:
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
    columns = list(dict.fromkeys((one["contender"], one["beta"]) for one in found))
    shape = (len(columns), len(PUSHED)) if narrow else (len(PUSHED), len(columns))
    figure, grid = style.panels(
        *shape, height=(1.95 if narrow else 1.72) * shape[0] + 0.3, narrow=narrow, squeeze=False
    )
    words = []
    for i, (pushed, _) in enumerate(PUSHED):
        for k, (contender, beta) in enumerate(columns):
            axes = grid[k][i] if narrow else grid[i][k]
            one = next(
                each for each in found if (each["contender"], each["beta"], each["pushed"]) == (contender, beta, pushed)
            )
            does = _panel(axes, one)
            who = "Cartesian" if contender == PAPERS else "Euler"
            if i == 0:
                heading = "Cartesian, any β" if who == "Cartesian" else f"Euler, β = {beta:.0f}°"
                axes.set_title(heading, color=COLOURS[contender])
            words.append(f"{who}, beta {beta:.0f} degrees, moment about {pushed}: {does}")
    _head(figure, grid, narrow)
    return figure, (
        "Drawings of a robot's hand that complies with moments about x and y and is stiff against moments about z. "
        f"{'; '.join(words)}."
    )


def _head(figure: Any, grid: Any, narrow: bool) -> None:
    """Say what each row of panels (on a phone each column) is pushed by."""
    for i, (_, what) in enumerate(PUSHED):
        first, second = what.split(", ")
        if narrow:
            axes = grid[0][i]
            axes.annotate(
                f"{first},\n{second}", (0.5, 1.0), xytext=(0, 26), xycoords="axes fraction",
                textcoords="offset points", ha="center", va="bottom", fontsize=9.5, fontweight="bold",
            )  # fmt: skip
        else:
            axes = grid[i][0]
            axes.set_ylabel(f"{first},\n{second}", fontweight="bold", fontsize=9.5, labelpad=6)


def _panel(axes: Any, one: dict) -> str:
    """One hand; what it does, in words."""
    axes.set(xlim=WINDOW[:2], ylim=WINDOW[2:], aspect="equal", xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    draw_hand(axes, math.radians(one["beta"]))
    draw_frame(axes)
    moment = np.eye(3)["xyz".index(one["pushed"])]
    draw_turn(axes, moment, 1.0, style.INK, 5.0, 1.1, (0, (4, 2.5)))
    colour = COLOURS[one["contender"]]
    if math.isnan(one["off"]):
        words = "stays" if one["pushed"] == "z" else "does not turn"
    else:
        direction = one["axis"] * math.copysign(1.0, one["axis"] @ moment)
        draw_turn(axes, direction, min(one["share"], 1.0), colour, 4.0, 2.8)
        words = f"{one['off']:.0f}° off, {100 * one['share']:.0f} %"
    place = {"transform": axes.transAxes, "ha": "center", "va": "bottom"}
    axes.text(0.5, 0.0, words, color=colour, fontsize=10, fontweight="bold", **place)
    return words
