"""Draw where each law fails as a map of the world: a point is where the body's x axis, the column n of R, points.

Longitude is alpha, latitude -beta, in Hammer's projection, which keeps areas: Haar measure on SO(3) is area on this
map times the turn gamma about n, which the map does not show (n is the base point of Hopf's fibration). The poles of
the map are the poles of Z-Y-X angles, its rim is alpha = +-pi, and the dashed meridians bound the paper's range.
"""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from bench.findings.start_sets import AT_REST
from report.figures.kit import html, laws, style
from report.figures.kit.dots import dots
from report.figures.kit.inline import Drawing, responsive_picture

DRAWN = 1200
"""Settled dots a map; every failing start is drawn."""

HALO = [withStroke(linewidth=2.5, foreground=style.PAPER)]
FINE = np.linspace(-0.5, 0.5, 61) * np.pi


def hammer(longitude: Any, latitude: Any) -> Any:
    """Equal-area coordinates of a direction: an ellipse of half axes 2 and 1 (up to sqrt 2)."""
    root = np.sqrt(1.0 + np.cos(latitude) * np.cos(np.asarray(longitude) / 2.0))
    return 2.0 * np.cos(latitude) * np.sin(np.asarray(longitude) / 2.0) / root, np.sin(latitude) / root


@responsive_picture
def world(episodes: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw a map a law: settled uniform starts in grey, failing ones by outcome, directed points larger.

    Args:
        episodes: rows of one engine.
    """
    parts = laws.each(episodes[episodes["start_set"].isin(("uniform", *AT_REST))])
    figure, places = style.grid(len(parts), 2.2, 2.2, narrow, top=0.5)
    said, met = [], set()
    for axes, (name, title, rows) in zip(places.flat, parts, strict=False):
        draw_globe(axes)
        axes.set_title(title, color=style.look(name).colour)
        said.append(draw_starts(axes, title, rows))
        met |= set(rows["outcome"].astype(str))
        for line in axes.lines:
            line.set_in_layout(False)  # marks on the rim are not clipped, and must not shrink the map
    keys = [
        Line2D([], [], color=colour, marker=marker, markersize=5.5, linestyle="none", label=outcome)
        for outcome, (colour, marker) in style.OUTCOMES.items()
        if outcome in met
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=3 if narrow else 6, fontsize=9)
    return figure, (
        "Maps of the direction of the body's x axis at the start, with longitude alpha and latitude minus beta. "
        + " ".join(said)
    )


def draw_globe(axes: Any) -> None:
    """Draw the rim, the paper's range, three parallels and three numbered meridians."""
    axes.set(aspect="equal", xlim=(-2.02, 2.02), ylim=(-1.02, 1.02))
    axes.axis("off")
    dashed = {"color": style.INK, "linewidth": 0.9, "linestyle": style.DASHED}
    for degrees in (-180, -90, 90, 180):
        look = dashed if abs(degrees) == 90 else {"color": style.MUTED, "linewidth": 0.8}
        axes.plot(*hammer(np.radians(degrees) * np.ones_like(FINE), FINE), **look)
    for latitude in (-np.pi / 4, 0.0, np.pi / 4):
        axes.plot(*hammer(2.0 * FINE, latitude * np.ones_like(FINE)), color=style.GRID, linewidth=0.7, zorder=0)
    for degrees in (-90, 0, 90):
        x, y = hammer(np.radians(degrees), 0.0)
        look = {"ha": "center", "va": "top", "fontsize": 8.5, "zorder": 6, "path_effects": HALO}
        axes.text(x, y - 0.02, f"{degrees}°".replace("-", "\N{MINUS SIGN}"), **look)


def draw_starts(axes: Any, title: str, rows: pd.DataFrame) -> str:
    """Draw a law's starts; return their outcomes in words."""
    x, y = hammer(rows["alpha0"], -rows["beta0"])
    rows = rows.assign(x=x, y=y)
    is_uniform = rows["start_set"] == "uniform"
    good = rows[is_uniform & (rows["outcome"] == "settled")].head(DRAWN)
    dots(axes, good["x"], good["y"], style.OUTCOMES["settled"][0], 1.7)
    rim = {"linestyle": "none", "clip_on": False, "markeredgewidth": 0.4, "markeredgecolor": style.PAPER}
    for outcome, (colour, marker) in style.OUTCOMES.items():
        for chosen, size in ((is_uniform, 3.6), (~is_uniform, 6)):
            failed = rows[chosen & (rows["outcome"] == outcome) & (outcome != "settled")].drop_duplicates(["x", "y"])
            axes.plot(failed["x"], failed["y"], marker=marker, color=colour, markersize=size, zorder=size, **rim)
    uniform, directed = rows[is_uniform], rows[~is_uniform]
    bad = int((uniform["outcome"] != "settled").sum())
    ends = ", ".join(f"{count} {word}" for word, count in directed["outcome"].astype(str).value_counts().items())
    return f"{title}: {html.number(bad)} of {html.number(len(uniform))} uniform starts fail; directed starts: {ends}."
