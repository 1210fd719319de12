"""The page on compliance: the axis about which a hand yields, by the paper's force control and by accelerations.

The curves are the closed form of `compliance_theory` for the arm, and the dots are measured rows of the wrench probe.
In the drawings the hand is the same: only the frame that is attached to it is rotated, by beta about y.
"""

import itertools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.ticker import NullLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from scipy.spatial.transform import Rotation

from bench.experiments.tables.run import Run
from bench.findings.amounts import join_words
from bench.findings.claims.side_by_side import compliances, predicted
from report.figures.arms.arm_rows import name_arm
from report.figures.contact import as_arms_run
from report.figures.contact.in_contact import EULER, PAPERS, PAPERS_EULER, level, of, of_task
from report.figures.kit import style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import in_run
from report.figures.kit.spelling import power

PROBE = "wrench-probe"
COLOURS = {PAPERS: style.CARTESIAN, PAPERS_EULER: style.EULER}
NAMES = {PAPERS: "Cartesian compliance", PAPERS_EULER: "Euler Jacobian"}
COORDINATES = {PAPERS: "", PAPERS_EULER: "zyx-euler"}
BETAS = (0, 30, 60, 85)
"""Tilts [deg] that the text names."""
MOST_DEG = 85.0
"""Largest tilt that is drawn: at 90 degrees the angles are singular."""
CURVE_DEG = np.linspace(0.0, MOST_DEG, 35)
RATIOS = 0.2, 0.5, 1, 2, 5, 10, 20
DRAWN_DEG = 60
"""Tilt of the second drawing."""
ORDER = "about x and y"

REACH = 1.12
"""Length of an axis on one side of the hand."""
ELEVATION_DEG, AZIMUTH_DEG = 16.0, -68.0
EYE = Rotation.from_euler("yz", (-ELEVATION_DEG, AZIMUTH_DEG), degrees=True).apply((1.0, 0.0, 0.0))
FACES = np.array([(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)])
CORNERS = np.array([*itertools.product((-1, 1), repeat=3)])[FACES]
WRIST, PALM = ((0.0, 0.0, 0.38), (0.10, 0.10, 0.20)), ((0.0, 0.0, 0.06), (0.34, 0.14, 0.13))
FINGERS = [((x, 0.0, -0.30), (0.06, 0.10, 0.24)) for x in (-0.25, 0.25)]
"""Middle and half edges of boxes in the hand's frame, at the middle of the palm."""


class HandTurn(NamedTuple):
    """What a hand does under equal moments about x, where it should comply, and about z, where it should hold.

    Attributes:
        beta_deg: Tilt of the frame that is attached to the hand [deg].
        axis: Axis about which a moment about x turns the hand, in the base frame, of length 1.
        off_deg: Angle between this axis and x [deg].
        held: Rotation by a moment about z, over that of Cartesian compliance by a moment about x.
    """

    beta_deg: float
    axis: np.ndarray
    off_deg: float
    held: float


def facts(run: Run) -> dict:
    """Return the numbers of the probe, the damping that two designs give an impedance, and the axes of turning."""
    rows = of_task(run, PROBE)
    damping, by_acceleration = in_run(as_arms_run.facts, run) or {}, level(of(rows, EULER, ORDER))
    by_acceleration = by_acceleration[by_acceleration["outcome"] == "done"]  # its misalignment is beta
    misalignment_deg = np.degrees(by_acceleration["misalignment_rad"])
    off_by_accelerations = float((misalignment_deg - by_acceleration["beta_deg"].abs()).abs().max())
    return {
        "axes_arm": name_arm(shown_arm(rows)),
        **describe_turns(rows),
        "off_by_accelerations": power(off_by_accelerations),
        **{name: damping[name] for name in ("felt_least", "felt_most", "double") if name in damping},
        "compliance-axes": axes_of_turning(rows),
    }


def shown_arm(rows: pd.DataFrame) -> str:
    """Return the UR5e if it is there: its inertia, through which moments act, hardly couples x and z at home."""
    return max(rows["arm"])


def probed(rows: pd.DataFrame, contender: str) -> pd.DataFrame:
    """Return the finished rows of the shown arm and a controller whose goal has beta alone, up to MOST_DEG."""
    found = of(level(rows[rows["arm"] == shown_arm(rows)]), contender, ORDER)
    return found[found["beta_deg"].between(0.0, MOST_DEG) & (found["outcome"] == "done")]


def measure(rows: pd.DataFrame, contender: str) -> list[HandTurn]:
    """Return what the hand did in each row of the probe."""
    full = float(probed(rows, PAPERS)["c_xx"].median())
    own = probed(rows, contender)
    return [read_turn(C, beta, full) for C, beta in zip(compliances(own), own["beta_deg"], strict=True)]


def predict(rows: pd.DataFrame, contender: str) -> list[HandTurn]:
    """Return what the closed form says of the hand along CURVE_DEG."""
    first = probed(rows, contender).head(1)
    tilted = pd.concat([first] * len(CURVE_DEG), ignore_index=True).assign(beta=np.radians(CURVE_DEG))
    straight = predicted(probed(rows, PAPERS).head(1), COORDINATES[PAPERS])
    full = float(straight[0, 0, 0])
    compliance = predicted(tilted, COORDINATES[contender])
    return [read_turn(C, beta, full) for C, beta in zip(compliance, CURVE_DEG, strict=True)]


def read_turn(C: np.ndarray, beta_deg: float, full: float) -> HandTurn:
    """Return the turn of a compliance matrix; full: the rotation of Cartesian compliance per moment about x."""
    size = float(np.linalg.norm(C[:, 0]))
    # an axis has no sense: of both, that along x is taken
    axis = C[:, 0] * math.copysign(1.0, C[0, 0]) / size
    off_deg = math.degrees(math.acos(min(float(axis[0]), 1.0)))
    return HandTurn(float(beta_deg), axis, off_deg, float(np.linalg.norm(C[:, 2])) / full)


def nearest(turns: Sequence[HandTurn], beta_deg: float) -> HandTurn:
    """Return the turn whose tilt is the nearest: the grids of suites differ."""
    return min(turns, key=lambda turn: abs(turn.beta_deg - beta_deg))


def unit(axis: str) -> np.ndarray:
    """Return the base axis x, y or z."""
    return np.eye(3)["xyz".index(axis)]


def beta_of(turn: HandTurn) -> str:
    """Return the tilt of a turn, on one line: β = 30°."""
    space = "\N{NO-BREAK SPACE}"
    return f"β{space}={space}{turn.beta_deg:.0f}°"


def describe_turns(rows: pd.DataFrame) -> dict[str, str]:
    """Return how far off the moment the Euler hand turns at each tilt, and how far about the held axis."""
    turns, cartesian = measure(rows, PAPERS_EULER), measure(rows, PAPERS)
    named = dict.fromkeys(nearest(turns, beta).beta_deg for beta in BETAS if beta)
    tilted = [nearest(turns, beta) for beta in named]
    return {
        "off": join_words([f"{turn.off_deg:.0f}° at {beta_of(turn)}" for turn in tilted]),
        "held": join_words([f"{turn.held:.2g} at {beta_of(turn)}" for turn in tilted]),
        "off_cartesian": power(max(turn.off_deg for turn in cartesian)),
        "held_cartesian": f"{max(turn.held for turn in cartesian):.2g}",
    }


@responsive_picture
def axes_of_turning(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw the error of the axis and the unwanted rotation against beta, and two hands beside them."""
    figure, panels, views = place_panels(narrow)
    words = []
    for contender in (PAPERS, PAPERS_EULER):
        draw_curves(panels, rows, contender)
        turns = measure(rows, contender)
        errors = ", ".join(f"{turn.off_deg:.0f} degrees and {turn.held:.2g}" for turn in turns)
        tilts = ", ".join(f"{turn.beta_deg:.0f}" for turn in turns)
        words.append(f"{NAMES[contender]} at {tilts} degrees: {errors}")
    panels[0].plot(CURVE_DEG, CURVE_DEG, color=style.MUTED, linewidth=1.0, linestyle=style.DASHED, zorder=1)
    panels[0].set(ylabel="error of the axis [deg]", ylim=(-4, 95), yticks=(0, 30, 60, 90))
    panels[1].set(yscale="log", ylabel="rotation about z / x", xlabel="tilt β of the hand's frame [deg]")
    panels[1].set_yticks(RATIOS, [f"{ratio:g}" for ratio in RATIOS])
    panels[1].yaxis.set_minor_locator(NullLocator())
    for panel in panels:
        panel.set(xlim=(-2, 88), xticks=(0, 30, 60, 85))
    label_curves(panels[0])
    euler = measure(rows, PAPERS_EULER)
    for view, beta in zip(views, (0, DRAWN_DEG), strict=True):
        draw_hand(view, nearest(euler, beta))
    return figure, (
        "Error of the axis about which a moment about x turns the hand, and rotation by a moment "
        f"about z, against the tilt of the hand's frame. {'. '.join(words)}. Beside it two "
        f"drawings of one hand with its frame at 0 and at {DRAWN_DEG} degrees."
    )


def place_panels(narrow: bool) -> tuple[Figure, list[Axes], list[Any]]:
    """Return the figure, its two panels of curves and its two drawings; on a phone the drawings lie below."""
    width = style.PHONE_WIDTH_IN if narrow else style.TEXT_WIDTH_IN
    figure = Figure(figsize=(width, 7.0 if narrow else 4.8))
    view = {"projection": "3d", "proj_type": "ortho", "computed_zorder": False}
    if narrow:
        grid = GridSpec(3, 2, figure=figure, height_ratios=(1.2, 1.0, 1.1))
        panels = [figure.add_subplot(grid[row, :]) for row in (0, 1)]
        views = [figure.add_subplot(grid[2, column], **view) for column in (0, 1)]
    else:
        grid = GridSpec(2, 2, figure=figure, width_ratios=(1.7, 1.0))
        panels = [figure.add_subplot(grid[row, 0]) for row in (0, 1)]
        views = [figure.add_subplot(grid[row, 1], **view) for row in (0, 1)]
    return figure, panels, views


def draw_curves(panels: Sequence[Axes], rows: pd.DataFrame, contender: str) -> None:
    """Draw a controller's closed form as a line and its measured rows as dots, in both panels."""
    theory, measured, colour = predict(rows, contender), measure(rows, contender), COLOURS[contender]
    for panel, field in zip(panels, ("off_deg", "held"), strict=True):
        line = [getattr(turn, field) for turn in theory]
        dots = [getattr(turn, field) for turn in measured]
        panel.plot([turn.beta_deg for turn in theory], line, color=colour, linewidth=1.6)
        panel.plot([turn.beta_deg for turn in measured], dots, "o", color=colour, markersize=5)


def label_curves(panel: Axes) -> None:
    """Name the curves of the first panel where they are free."""
    panel.text(3, 62, NAMES[PAPERS_EULER], color=COLOURS[PAPERS_EULER], fontsize=10)
    panel.text(30, 5, NAMES[PAPERS], color=COLOURS[PAPERS], fontsize=10)
    panel.text(3, 76, "dashed: commanded accelerations", color=style.MUTED, fontsize=10)


def draw_hand(axes: Any, turn: HandTurn) -> None:
    """Draw the hand with its frame, the axis of the moment, and the axis about which the hand turns."""
    axes.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1.15, 0.85))
    axes.set_box_aspect((1, 1, 1), zoom=1.75)
    axes.view_init(elev=ELEVATION_DEG, azim=AZIMUTH_DEG)
    axes.axis("off")
    faces = np.concatenate([middle + half * CORNERS for middle, half in (WRIST, PALM, *FINGERS)])
    axes.add_collection3d(Poly3DCollection(faces, facecolor=style.GRID, edgecolor=style.MUTED, linewidth=0.6, zorder=2))
    draw_frame(axes, turn.beta_deg)
    draw_axis(axes, turn.axis, color=COLOURS[PAPERS_EULER], zorder=4, linewidth=2.8, linestyle="-")
    moment = {"color": style.INK, "zorder": 5, "linewidth": 1.1, "linestyle": style.DASHED}
    draw_axis(axes, unit("x"), **moment)
    draw_ring(axes, unit("x"), **moment)
    axes.set_title(f"β = {turn.beta_deg:.0f}°: off by {turn.off_deg:.0f}°", color=COLOURS[PAPERS_EULER], loc="center")


def draw_frame(axes: Any, beta_deg: float) -> None:
    """Draw the frame that is attached to the hand, rotated by beta about y."""
    frame = Rotation.from_euler("y", beta_deg, degrees=True).as_matrix()
    corner = np.array((-0.95, 0.0, -0.75))
    above = {"y": np.array((0.0, 0.0, 0.15))}  # or z's arrow runs through the letter where the frame is tilted
    for name, direction in zip("xyz", frame.T, strict=True):
        axes.quiver(*corner, *(0.42 * direction), color=style.MUTED, linewidth=1.3, arrow_length_ratio=0.3)
        place = corner + 0.58 * direction + above.get(name, 0.0)
        axes.text(*place, name, color=style.MUTED, fontsize=9, ha="center", va="center")


def draw_axis(axes: Any, direction: np.ndarray, **look: Any) -> None:
    """Draw an axis through the hand."""
    axes.plot(*np.outer(direction, (-0.85 * REACH, REACH)), **look)


def draw_ring(axes: Any, direction: np.ndarray, **look: Any) -> None:
    """Draw a ring with a head around an axis through the hand."""
    radius = 0.27
    turned, _ = Rotation.align_vectors([direction, EYE], [(0, 0, 1), (0, -1, 0)], weights=[np.inf, 1.0])
    angles = np.r_[np.linspace(-0.35 * math.pi, 1.2 * math.pi, 60), np.array((1.2, 1.2, 1.5)) * math.pi]
    radii = radius * np.r_[np.ones(60), 0.3, 1.7, 1.0]  # the last three are the corners of the head
    points = np.column_stack((radii * np.cos(angles), radii * np.sin(angles), np.full(63, 0.8 * REACH)))
    ring, head = np.split(turned.apply(points), [60])
    axes.plot(*ring.T, **{**look, "linestyle": "-", "linewidth": 1.6})
    axes.add_collection3d(Poly3DCollection([head], facecolor=look["color"], zorder=look["zorder"]))
