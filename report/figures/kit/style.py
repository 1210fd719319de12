"""How figures look: one colour for each law of the argument, and the style that figures are drawn in.

Eight laws have a colour of their own, in every figure, in the map of advice, in the balls and on the live page. All
other laws are grey everywhere, so that a colour is an identity. The eight are distinguished with any colour vision,
each has a twin for dark pages, and both have a contrast of at least 3 to their page (tests/report/test_colours.py).
"""

import itertools
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib import font_manager
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Curve

from report.figures.kit import laws

FONTS = Path(__file__).parent / "fonts"
PAPER_STYLE = Path(__file__).parent / "paper.mplstyle"
"""The style all figures are drawn in; the colours of its words, axes and grid are INK, MUTED and GRID."""
TEXT_WIDTH_IN = 7.5  # the column of a page at 1280 pixels, 720 of CSS's 96 to the inch
PHONE_WIDTH_IN = 3.7  # the column of a page at 390 pixels, so that words keep their size there

INK = "#1c2430"  # words, axes, reference curves
MUTED = "#667085"  # ticks, annotations, bounds
GRID = "#dfe3e8"
PAPER = "#fefefe"  # the page itself: halos, and the rim of a marker
ON_COLOUR = "#10151c"  # words on a bar of a light colour, dark on both pages

# light page -> dark page; `inline` writes both into the SVG
TWINS = {
    INK: "#e6eaf0",
    MUTED: "#9aa5b4",
    GRID: "#343c48",
    PAPER: "#14181e",
    ON_COLOUR: "#14181f",
    # the eight of LAW_COLOURS
    "#064fa8": "#5a7cfd",  # blue
    "#cc4215": "#f68019",  # vermillion
    "#019669": "#48d589",  # green
    "#d763bb": "#b860ab",  # purple
    "#099bdd": "#8ae5ff",  # sky
    "#80314e": "#fa1a54",  # wine
    "#963cfc": "#e491ff",  # violet
    "#ae8f13": "#f8d837",  # yellow
    # of controllers and Jacobians, and a word that no law of ours uses
    "#0072b2": "#5cb8f0",  # blue
    "#d55e00": "#ff9350",  # vermillion
    "#e69f00": "#f5bd45",  # orange
    "#000001": "#ffffff",  # stuck: the strongest contrast there is
}


COLOURS = {
    "blue": "#064fa8",
    "vermillion": "#cc4215",
    "green": "#019669",
    "purple": "#d763bb",
    "orange": "#e69f00",
    "sky": "#099bdd",
    "yellow": "#ae8f13",
    "wine": "#80314e",
    "violet": "#963cfc",
}
"""What the colour words of a law's own look are."""

LAW_COLOURS = {
    "rotation-matrix": COLOURS["blue"],
    "linearized-euler": COLOURS["vermillion"],
    "feedback-linearized": COLOURS["green"],
    "quaternion-shortest": COLOURS["purple"],
    "hybrid": COLOURS["sky"],
    "mrp": COLOURS["wine"],
    "mrp-memory": COLOURS["violet"],
    "late-braking": COLOURS["yellow"],
}
"""The laws of the argument: the paper's three, the quaternion, what is advised, and ours."""
REST = MUTED
"""The colour of every other law that came with the benchmark."""
YOURS = INK
"""The colour of a law that a user added to the run."""

CARTESIAN, EULER = "#0072b2", "#d55e00"
"""Colours of controllers and Jacobians: on Cartesian axes, and on Euler angles."""


class DrawnLook(NamedTuple):
    """How one regulator is drawn, in every figure."""

    colour: str
    marker: str
    line: str | tuple


SOLID, DASHED, DOTTED, DASH_DOT = "-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2))

LINES: dict[str, str | tuple] = {"solid": SOLID, "dashed": DASHED, "dotted": DOTTED, "dash-dot": DASH_DOT}
# For a law that has no look of its own: 5 markers x 3 lines, chosen by its name.
SPARE_MARKERS = ("P", "X", "h", "*", "<")
SPARE_LINES: tuple[Any, ...] = (SOLID, DASHED, DASH_DOT)


def colour_of(name: str) -> str:
    """Return the colour of a law by its name, or by the name of a contender (`regulator/representation@...`)."""
    contender, word = name.partition("@")[0], laws.regulator_of(name)
    # The argument is about the paper's laws on the paper's angles; the same law on other coordinates is another one.
    is_elsewhere = "/" in contender and contender not in laws.TITLES
    if word in LAW_COLOURS and not is_elsewhere:
        return LAW_COLOURS[word]
    return YOURS if laws.is_users(word) else REST


def look(name: str) -> DrawnLook:
    """Return how a law or a contender is drawn, unknown ones included."""
    word = laws.regulator_of(name)
    regulator = laws.regulator(word)
    if regulator and regulator.display.look:
        words = regulator.display.look
        return DrawnLook(colour_of(name), words.marker, LINES[words.line])
    spare = [*itertools.product(SPARE_MARKERS, SPARE_LINES)]
    marker, line = spare[mark(word) % len(spare)]
    return DrawnLook(colour_of(name), marker, line)


def mark(text: str) -> int:
    """Return a text's own number of 32 bits, equal in every process."""
    return zlib.crc32(text.encode())


for face in sorted(FONTS.glob("*.ttf")):  # the bundled faces are made known to matplotlib
    font_manager.fontManager.addfont(str(face))


def panels(rows: int = 1, cols: int = 1, *, height: float = 3.2, narrow: bool = False, **subplots: Any) -> Any:
    """Return a figure of the page's width, [in] high, and its axes; `narrow` is the same for a phone.

    Plain `Figure`, no pyplot: nothing is shown twice, nothing stays open, and no backend is chosen for anybody.
    """
    figure = Figure(figsize=(PHONE_WIDTH_IN if narrow else TEXT_WIDTH_IN, height))
    axes = figure.subplots(rows, cols, **subplots)
    return figure, axes


def listed(axes: Axes) -> None:
    """Axes whose rows are a list of names: no lines and no ticks between them."""
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)


def label_line(axes: Axes, x: float, y: float, text: str, colour: str = INK, **place: Any) -> None:
    """Name a curve beside it, which reads faster than a legend."""
    place = {"ha": "left", "va": "center", "fontsize": 9.5, **place}
    axes.text(x, y, text, color=colour, **place)


def apart(places: Sequence[float], gap: float) -> list[float]:
    """Move places nearer than `gap` to each other so far apart: for labels beside curves."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    moved = [float(place) for place in places]
    for _ in places:
        for low, high in itertools.pairwise(order):
            short = max(0.0, gap - (moved[high] - moved[low])) / 2.0
            moved[low], moved[high] = moved[low] - short, moved[high] + short
    return moved


def dots(axes: Axes, x: Any, y: Any, colour: str, size: float = 2.2, **look: Any) -> None:
    """Draw round dots of this size [pt] at (x, y) as one path, a tenth of the bytes of markers; the limits stay."""
    points = np.column_stack((x, y)).astype(float)
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        return
    codes = np.tile([Curve.MOVETO, Curve.LINETO], len(points))
    path = Curve(np.repeat(points, 2, axis=0), codes)
    path.should_simplify = False
    axes.add_artist(
        PathPatch(path, fill=False, edgecolor=colour, linewidth=size, capstyle="round", joinstyle="round", **look)
    )
