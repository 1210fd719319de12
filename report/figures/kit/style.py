"""How figures look: one colour, marker and line per regulator everywhere, and the style they are drawn in.

Colours are Okabe and Ito's eight, distinguished with any colour vision, each with a lighter twin for dark pages.
Colour never stands alone: the marker and the line differ too, so that a print in grey still reads.
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
    "#0072b2": "#5cb8f0",  # blue
    "#d55e00": "#ff9350",  # vermillion
    "#009e73": "#3fd0a4",  # bluish green
    "#cc79a7": "#eda3cb",  # reddish purple
    "#e69f00": "#f5bd45",  # orange
    "#56b4e9": "#9fd4f5",  # sky blue
    "#a39400": "#e9dd4f",  # yellow, darkened: Okabe and Ito's own vanishes on white
    "#b9c3cf": "#475263",  # settled: what needs no attention
    "#000001": "#ffffff",  # stuck: the strongest contrast there is
}


ARGUED = ("rotation-matrix", "linearized-euler", "feedback-linearized", "mrp-memory", "late-braking")
"""The laws that have a colour among all others: the paper's three, the advised one, and ours."""
REST = MUTED
"""The colour of the others there."""


class Look(NamedTuple):
    """How one regulator is drawn, in every figure."""

    colour: str
    marker: str
    line: str | tuple


SOLID, DASHED, DOTTED, DASH_DOT = "-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2))

# What the words of a law's own look are.
COLOURS = {
    "blue": "#0072b2",
    "vermillion": "#d55e00",
    "green": "#009e73",
    "purple": "#cc79a7",
    "orange": "#e69f00",
    "sky": "#56b4e9",
    "yellow": "#a39400",
}
LINES: dict[str, str | tuple] = {"solid": SOLID, "dashed": DASHED, "dotted": DOTTED, "dash-dot": DASH_DOT}
# For a law that has no look of its own: 3 colours x 5 markers x 3 lines, chosen by its name.
SPARE_COLOURS = ("#a39400", "#56b4e9", "#cc79a7")
SPARE_MARKERS = ("P", "X", "h", "*", "<")
SPARE_LINES: tuple[Any, ...] = (SOLID, DASHED, DASH_DOT)


def look_among_all(name: str) -> Look:
    """Return how a law is drawn where two dozen are: the laws of the argument in colour, and the rest in grey."""
    own = look(name)
    return own if name.partition("@")[0] in (*ARGUED, *laws.TITLES) else own._replace(colour=REST)


def look(name: str) -> Look:
    """How to draw a regulator or a contender (`regulator/representation@...`), unknown ones included."""
    word = laws.regulator_of(name)
    own = laws.regulator(word)
    if not own or not own.display.look:
        every = [*itertools.product(SPARE_COLOURS, SPARE_MARKERS, SPARE_LINES)]
        return Look(*every[mark(word) % len(every)])
    words = own.display.look
    return Look(COLOURS[words.colour], words.marker, LINES[words.line])


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
