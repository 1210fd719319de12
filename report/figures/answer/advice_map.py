"""The map of advice: drawn for print and for pages without scripts; report/_extra/advice.js makes it answer a reader.

A plane has the damping ratio and one more number. Each of its places has the colour and the letter of the law that is
advised in the nearest situation of the plane that was simulated.
"""

import functools
import html as markup
import json
import math
import string
from collections import Counter
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path as Outline
from scipy.spatial import Voronoi

from bench.experiments.tables.run import Run
from bench.findings.selection.regions import RuleVerdict, decide_all, read_map
from bench.findings.selection.sensitivity import RULES
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, Picture, responsive_picture
from tasks.situation import COORDINATES, NOMINAL, Situation

SHOWN = {
    "the rule": "our rule",
    "noise is left out": "without the noise test",
    "no memory": "without memory",
    "a continuous command": "continuous commands only",
    "times within 10 % are equal": "times within 10 % are equal",
}
"""Rules that the reader may choose from, and what they are called there."""
FIRST_RULE, FIRST_PLANE = "the rule", "bound"
"""What is drawn without a script, and chosen at first."""

NONE = "no published or adapted law meets the requirements"
HATCH = "////"
LETTER_APART, LETTER_CLEAR, LETTER_INSIDE = 0.6, 0.1, 0.035
"""In units of the plane: between two letters of a law, between any two, and from a letter to the edge."""


class MapPoint(NamedTuple):
    """A simulated situation of a plane: its place, and the law advised there; None where no law qualifies."""

    x: float
    y: float
    law: str | None


class MapFigure(NamedTuple):
    """The map as a part of a page, in place of a picture: it has alternative text, and is drawn for a phone too."""

    picture: Picture
    choices: str
    data: str

    @property
    def alt(self) -> str:
        """Return the words of the drawing."""
        return self.picture.alt

    def _repr_html_(self) -> str:
        said = (
            "The advised law over the damping ratio and a second number: the arrow keys go from situation to situation"
        )
        return (
            f'<div class="advice-choices" hidden>{self.choices}</div>'
            f'<div class="advice-drawn">{self.picture._repr_html_()}</div>'
            '<canvas id="advice-map" tabindex="0" role="application" aria-roledescription="map" '
            f'aria-label="{said}" aria-describedby="advice-said" hidden></canvas>'
            '<p id="advice-keys" class="advice-keys" hidden></p>'
            '<p id="advice-said" class="hint" role="status" hidden></p>'
            f'<script type="application/json" id="advice-data">{self.data}</script>'
        )


def facts(_: Run) -> dict[str, Any]:
    """Return the map, and what its first view shows in a sentence."""
    options = {name: COORDINATES[name].title for name in planes()}
    choices = _select("plane", "Vertical axis", options) + _select("rule", "Rule", SHOWN)
    points = list_points(FIRST_PLANE, FIRST_RULE)
    return {
        "map": MapFigure(draw_plane(points, letters_of(advised_laws())), choices, write_data()),
        "finding": say_finding(points),
    }


def say_finding(points: Sequence[MapPoint]) -> str:
    """Return which laws the situations of a plane are advised, the most frequent first."""
    counts = Counter(point.law for point in points if point.law)
    unanswered = len(points) - counts.total()
    (first, most), *others = counts.most_common()
    rest = ", ".join(f"{families.word(law)} ({count})" for law, count in others)
    others_text = f" The other advised laws, with their numbers of situations, are {rest}." if rest else ""
    none = f" In {unanswered} situations {NONE}." if unanswered else ""
    return (
        f"{families.word(first)} is advised in {most} of the {len(points)} simulated situations of this map."
        f"{others_text}{none}"
    )


def decide_shown(rule: str) -> dict[Situation, RuleVerdict]:
    """Return the verdict of a rule of SHOWN on every situation of the map."""
    return decide_all(rule=RULES[rule])


def planes() -> list[str]:
    """Return the numbers that may stand on the vertical axis."""
    return [name for name in COORDINATES if name != "zeta"]


def list_situations(name: str) -> list[Situation]:
    """Return the situations of the plane of the damping ratio and another number."""
    nominal = {"zeta": NOMINAL.zeta, name: getattr(NOMINAL, name)}
    return [at for at in decide_shown(FIRST_RULE) if at._replace(**nominal) == NOMINAL]


def list_points(name: str, rule: str) -> list[MapPoint]:
    """Return the situations of a plane with what a rule advises there."""
    verdicts = decide_shown(rule)
    return [MapPoint(*place_of(at, name), verdicts[at].law) for at in list_situations(name)]


def place_of(at: Situation, name: str) -> tuple[float, float]:
    """Return where a situation lies in a plane; 0 to 1, and above 1 what is unbounded."""
    return round(COORDINATES["zeta"].scale(at.zeta), 4), round(COORDINATES[name].scale(getattr(at, name)), 4)


def advised_laws() -> list[str]:
    """Return the laws that some rule of SHOWN advises somewhere, those of the first rule first."""
    counts = [Counter(verdict.law for verdict in decide_shown(rule).values() if verdict.law) for rule in SHOWN]
    return list(dict.fromkeys(law for count in counts for law, _ in count.most_common()))


def letters_of(laws: Sequence[str]) -> dict[str, str]:
    """Return a letter for each law."""
    return dict(zip(laws, string.ascii_uppercase, strict=False))


def weights_of(name: str) -> tuple[float, float]:
    """Return how much both numbers count where `bench advise` seeks the nearest situation."""
    return COORDINATES["zeta"].weight, COORDINATES[name].weight


def top_of(name: str) -> float:
    """Return the upper end of the vertical axis."""
    return max(COORDINATES[name].scale(level) for level in COORDINATES[name].levels)


class Cells(NamedTuple):
    """For each point the corners of the part of the plane to which it is the nearest, and borders between laws."""

    corners: list[np.ndarray]
    borders: list[np.ndarray]


def find_cells(points: Sequence[MapPoint], weights: tuple[float, float], top: float) -> Cells:
    """Return the cells of a plane."""
    places = np.array([(point.x, point.y) for point in points]) * weights
    right, up = np.array((1.0, top)) * weights
    # Mirrored at the four edges, the cells inside end at these edges.
    mirrored = [places * (-1.0, 1.0), places * (1.0, -1.0)]
    mirrored += [(2.0 * right, 0.0) - places * (1.0, -1.0), (0.0, 2.0 * up) - places * (-1.0, 1.0)]
    diagram = Voronoi(np.vstack([places, *mirrored]))
    corners = diagram.vertices / weights
    regions = (diagram.regions[diagram.point_region[number]] for number in range(len(points)))
    borders = []
    for pair, ends in zip(diagram.ridge_points, diagram.ridge_vertices, strict=True):
        is_inside = max(pair) < len(points)
        if is_inside and points[pair[0]].law != points[pair[1]].law:
            borders.append(corners[ends])
    return Cells([corners[region] for region in regions], borders)


def place_letters(points: Sequence[MapPoint], top: float) -> list[tuple[str, float, float]]:
    """Return (law, x, y) of letters: at the point of a law that is farthest from other laws, and again far from it."""
    # Each law has one letter before any has two, so that no second letter is in the way of a first one.
    firsts, more = [], []
    for law in dict.fromkeys(point.law for point in points if point.law):
        others = [point for point in points if point.law != law]
        own = [point for point in points if point.law == law]
        own.sort(key=lambda point: -min((_distance(point, other) for other in others), default=0.0))
        firsts.append(own[0])
        more.extend(own[1:])
    letters: list[MapPoint] = firsts
    for point in more:
        gaps = ((LETTER_APART if other.law == point.law else LETTER_CLEAR, other) for other in letters)
        if all(_distance(point, other) > gap for gap, other in gaps):
            letters.append(point)
    inside = []
    for point in letters:
        x = min(max(point.x, LETTER_INSIDE), 1.0 - LETTER_INSIDE)
        y = min(max(point.y, LETTER_INSIDE), top - LETTER_INSIDE)
        inside.append((str(point.law), x, y))
    return inside


def _distance(one: MapPoint, other: MapPoint) -> float:
    return math.hypot(one.x - other.x, one.y - other.y)


@responsive_picture
def draw_plane(points: Sequence[MapPoint], letters: dict[str, str], narrow: bool) -> Drawing:
    """Draw the first plane: cells in the colours of their laws, letters in them, and a key below."""
    name, top = FIRST_PLANE, top_of(FIRST_PLANE)
    figure, axes = style.panels(height=4.6 if narrow else 4.9, narrow=narrow)
    cells = find_cells(points, weights_of(name), top)
    keys = []
    for law in [*letters, None]:
        own = [cell for cell, point in zip(cells.corners, points, strict=True) if point.law == law]
        if own:
            keys.append(_draw_region(axes, own, law, letters))
    borders = Outline.make_compound_path(*(Outline(border) for border in cells.borders))
    axes.add_patch(PathPatch(borders, fill=False, edgecolor=style.PAPER, linewidth=0.8))
    across, up = [point.x for point in points], [point.y for point in points]
    style.dots(axes, across, up, style.PAPER, 1.6, alpha=0.6, zorder=3)
    for law, x, y in place_letters(points, top):
        axes.text(x, y, letters[law], color=style.PAPER, fontsize=12, fontweight="bold", ha="center", va="center")
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, top))
    axes.set_xticks(*zip(*list_ticks("zeta", 0.11 if narrow else 0.06), strict=True))
    axes.set_yticks(*zip(*list_ticks(name, 0.095 if narrow else 0.06), strict=True))
    axes.set(xlabel=COORDINATES["zeta"].title, ylabel=COORDINATES[name].title)
    axes.grid(visible=False)
    figure.legend(handles=keys, loc="outside lower left", ncols=1 if narrow else 3, handlelength=1.0, borderpad=0.0)
    return figure, f"Map of the advised laws. {say_finding(points)}"


def _draw_region(axes: Axes, cells: Sequence[np.ndarray], law: str | None, letters: dict[str, str]) -> Patch:
    """Draw the cells of one law, or of none; return their entry of the key."""
    outlines = [Outline(np.vstack([cell, cell[:1]]), closed=True) for cell in cells]
    region = Outline.make_compound_path(*outlines)
    if law is None:
        look: dict[str, Any] = {"facecolor": "none", "edgecolor": style.MUTED, "hatch": HATCH, "linewidth": 0.0}
        axes.add_patch(PathPatch(region, **look))
        return Patch(label=NONE, **look)
    colour = style.look(law).colour
    # An edge of the cells' own colour closes the seams between them.
    axes.add_patch(PathPatch(region, facecolor=colour, edgecolor=colour, linewidth=0.6))
    return Patch(label=f"{letters[law]}: {families.word(law)}", facecolor=colour)


def list_ticks(name: str, apart: float = 0.0) -> list[tuple[float, str]]:
    """Return (place, word) of the levels of a number, without those that are too near to the one before."""
    one = COORDINATES[name]
    ticks: list[tuple[float, str]] = []
    for level in one.levels:
        place = one.scale(level)
        if not ticks or place - ticks[-1][0] >= apart:
            ticks.append((place, "none" if math.isinf(level) else f"{level:g}"))
    return ticks


def write_data() -> str:
    """Return what the script reads, as JSON that may stand in a page."""
    names = families.in_order(read_map()["contender"].astype(str))
    letters = letters_of(advised_laws())
    data = {
        "laws": [_describe_law(name, letters.get(name, "")) for name in names],
        "rules": list(SHOWN),
        "none": NONE,
        "across": COORDINATES["zeta"].title,
        "zetas": list_ticks("zeta"),
        "planes": {name: _describe_plane(name, names) for name in planes()},
        "colours": {
            word: [colour, style.TWINS[colour]]
            for word, colour in (("ink", style.INK), ("muted", style.MUTED), ("paper", style.PAPER))
        },
    }
    return json.dumps(data, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")


def _describe_law(name: str, letter: str) -> dict[str, Any]:
    colour = style.look(name).colour
    return {"name": families.word(name), "letter": letter, "colour": [colour, style.TWINS[colour]]}


def _describe_plane(name: str, names: list[str]) -> dict[str, Any]:
    """Return the situations of a plane, each with its verdicts by SHOWN, and where the letters stand by SHOWN."""
    letters = [place_letters(list_points(name, rule), top_of(name)) for rule in SHOWN]
    return {
        "title": COORDINATES[name].title,
        "top": top_of(name),
        "weights": weights_of(name),
        "ticks": list_ticks(name),
        "points": [_describe_situation(at, name, names) for at in list_situations(name)],
        "letters": [[[names.index(law), round(x, 3), round(y, 3)] for law, x, y in own] for own in letters],
    }


def _describe_situation(at: Situation, name: str, names: list[str]) -> dict[str, Any]:
    x, y = place_of(at, name)
    verdicts = [_describe_verdict(at, rule, names) for rule in SHOWN]
    return {"x": x, "y": y, "words": at.describe(), "verdicts": verdicts}


def _describe_verdict(at: Situation, rule: str, names: list[str]) -> list[Any]:
    """Return the law that is advised (-1: none), its time, those that tie, ours, and whether ours are faster."""
    verdict = decide_shown(rule)[at]
    if verdict.law is None:
        return [-1]
    time = times_of()[at.word, verdict.law]
    tied, ours = ([names.index(law) for law in laws] for laws in (verdict.tied, verdict.ours))
    return [names.index(verdict.law), f"{time:.2f}", tied, ours, int(bool(verdict.faster))]


@functools.cache
def times_of() -> dict[tuple[str, str], float]:
    """Return (situation, law) -> the time in which 99 % of the starts settle, in 1/sqrt(kp)."""
    rows = read_map()
    keys = zip(rows["situation"].astype(str), rows["contender"].astype(str), strict=True)
    return dict(zip(keys, rows["time"], strict=True))


def _select(word: str, label: str, options: dict[str, str]) -> str:
    chosen = {"plane": FIRST_PLANE, "rule": FIRST_RULE}[word]
    inside = "".join(_option(key, text, key == chosen) for key, text in options.items())
    return f'<label>{label} <select id="advice-{word}">{inside}</select></label>'


def _option(key: str, text: str, is_chosen: bool) -> str:
    mark = " selected" if is_chosen else ""
    return f'<option value="{markup.escape(key)}"{mark}>{markup.escape(text)}</option>'
