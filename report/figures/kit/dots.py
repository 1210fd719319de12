"""Thousands of points as one path: segments of no length with round ends, a tenth of the bytes of as many markers."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path


def dots(axes: Axes, x: Any, y: Any, colour: str, size: float = 2.2, **look: Any) -> None:
    """Round dots of this size [pt] at (x, y), which do not move the limits of the axes."""
    points = np.column_stack((x, y)).astype(float)
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        return
    codes = np.tile([Path.MOVETO, Path.LINETO], len(points))
    path = Path(np.repeat(points, 2, axis=0), codes)
    path.should_simplify = False
    axes.add_artist(
        PathPatch(path, fill=False, edgecolor=colour, linewidth=size, capstyle="round", joinstyle="round", **look)
    )
