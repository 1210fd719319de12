"""How far one may turn about each axis before a law first fails: two hemispheres of axes, seen from +y and from -y.

Lambert's azimuthal projection, which keeps areas. The y axis looks at the reader because the poles of Z-Y-X angles
lie a quarter turn about it.
"""

import math

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D

from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

STEPS = ((120, "#d55e00", "o"), (150, "#e69f00", "s"), (181, "#56b4e9", "D"))
"""Upper edge [deg], colour and marker of each class of the first failing angle."""

RADIUS = math.sqrt(2.0)
DIRECTIONS = (
    ("$x$", (1.0, 0.0, 0.0)),
    ("$-x$", (-1.0, 0.0, 0.0)),
    ("$z$", (0.0, 0.0, 1.0)),
    ("$-z$", (0.0, 0.0, -1.0)),
)


@responsive_picture
def hemispheres(boundaries: pd.DataFrame, contender: str, narrow: bool):
    """First failing angle by axis for one law; axes along which nothing fails are small and grey."""
    rows = boundaries[boundaries["contender"] == contender]
    figure, grid = style.panels(1, 2, height=2.5 if narrow else 4.1, narrow=narrow)
    size = (42.0 if narrow else 88.0) / math.sqrt(max(1, len(rows)))
    for axes, sign in zip(grid, (1.0, -1.0), strict=True):
        _hemisphere(axes, rows[sign * rows["axis_y"] >= 0.0], sign, size)
        axes.set_title("axes towards $+y$" if sign > 0 else "axes towards $-y$", fontweight="normal", loc="center")
    figure.legend(handles=_keys(rows), loc="outside lower center", ncols=2 if narrow else 4, fontsize=9)
    fails = np.degrees(rows["fails_from_rad"].dropna())
    if fails.empty:
        return figure, f"Of {len(rows)} axes none has a failing angle."
    first = rows.loc[rows["fails_from_rad"].idxmin()]
    axis = ", ".join(f"{first[f'axis_{one}']:.2f}" for one in "xyz")
    return figure, (
        f"Of {len(rows)} axes {len(fails)} have a failing angle; the smallest is {fails.min():.0f} degrees, about "
        f"({axis}), the median {fails.median():.0f} degrees."
    )


def _hemisphere(axes, rows: pd.DataFrame, sign: float, size: float) -> None:
    axes.set(aspect="equal", xlim=(-1.62, 1.62), ylim=(-1.62, 1.62))
    axes.axis("off")
    turn = np.linspace(0.0, 2.0 * math.pi, 145)
    axes.plot(RADIUS * np.cos(turn), RADIUS * np.sin(turn), color=style.MUTED, linewidth=0.8)
    angle = np.degrees(rows["fails_from_rad"])
    never = rows[angle.isna()]
    axes.plot(*lambert(never, sign), "o", color=style.OUTCOMES["settled"][0], markersize=0.45 * size)
    low = 0.0
    for high, colour, marker in STEPS:
        chosen = rows[(angle >= low) & (angle < high)]
        axes.plot(*lambert(chosen, sign), marker, color=colour, markersize=size, markeredgewidth=0)
        low = high
    for name, direction in DIRECTIONS:
        x, y = lambert(pd.DataFrame([direction], columns=["axis_x", "axis_y", "axis_z"]), sign)
        axes.text(1.1 * x[0], 1.1 * y[0], name, ha="center", va="center", fontsize=9.5)


def lambert(rows: pd.DataFrame, sign: float) -> tuple[np.ndarray, np.ndarray]:
    """Equal-area coordinates of axes as seen from +y (sign 1) or -y (sign -1), z up, so that x is left or right."""
    stretch = np.sqrt(2.0 / (1.0 + sign * rows["axis_y"].to_numpy()))
    return -sign * stretch * rows["axis_x"].to_numpy(), stretch * rows["axis_z"].to_numpy()


def _keys(rows: pd.DataFrame) -> list[Line2D]:
    angle = np.degrees(rows["fails_from_rad"])
    keys, low = [], 0.0
    for high, colour, marker in STEPS:
        words = f"below {high}°" if low == 0.0 else f"{low:.0f}° to {min(high, 180)}°"
        count = int(((angle >= low) & (angle < high)).sum())
        keys.append(Line2D([], [], linestyle="none", marker=marker, color=colour, label=f"{words} ({count})"))
        low = high
    grey = style.OUTCOMES["settled"][0]
    keys.append(
        Line2D(
            [], [], linestyle="none", marker="o", markersize=3, color=grey, label=f"nowhere ({int(angle.isna().sum())})"
        )
    )
    return keys
