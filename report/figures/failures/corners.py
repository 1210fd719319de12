"""The linearized law's failing starts in the plane of alpha and gamma, for three ranges of beta."""

import numpy as np
import pandas as pd

from report.figures.kit import style
from report.figures.kit.dots import dots
from report.figures.kit.inline import responsive_picture

EDGES = (-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0)
"""Of sin(beta): equal parts of SO(3), for Haar measure is d alpha d(sin beta) d gamma."""

DRAWN = 700


@responsive_picture
def corners(episodes: pd.DataFrame, contender: str, narrow: bool):
    """Failing starts by outcome, settled ones grey; dashed: the paper's range of alpha.

    Args:
        episodes: rows of one engine and of the set uniform.
    """
    rows = episodes[episodes["contender"] == contender]
    figure, grid = style.beside(3, 3.2, 8.2, narrow, sharex=True, sharey=True)
    said, sine = [], np.sin(rows["beta0"])
    for axes, low, high in zip(grid.flat, EDGES[:-1], EDGES[1:], strict=True):
        part = rows[(sine > low) & (sine <= high)]
        failed = _panel(axes, part)
        first, last = np.degrees(np.arcsin([low, high]))
        axes.set_title(rf"$\beta$ from {_signed(first)} to {_signed(last)}", fontweight="normal")
        said.append(f"beta from {first:.0f} to {last:.0f} degrees: {failed} of {len(part)}")
    for axes in grid.flat if not narrow else grid.flat[-1:]:
        axes.set_xlabel(r"initial $\alpha$ [deg]")
    for axes in grid.flat if narrow else grid.flat[:1]:
        axes.set_ylabel(r"initial $\gamma$ [deg]")
    failed = rows[rows["outcome"] != "settled"]
    least = np.degrees(failed["alpha0"].abs().min()) if len(failed) else float("nan")
    return figure, (
        f"Failing starts in the plane of alpha and gamma; {'; '.join(said)}. They lie in corners of the plane; the "
        f"smallest |alpha| among them is {least:.0f} degrees."
    )


def _signed(degrees: float) -> str:
    return f"{degrees:.0f}°".replace("-", "\N{MINUS SIGN}")


def _panel(axes, part: pd.DataFrame) -> int:
    good = part[part["outcome"] == "settled"].head(DRAWN)
    dots(axes, np.degrees(good["alpha0"]), np.degrees(good["gamma0"]), style.OUTCOMES["settled"][0], 1.7)
    failed = part[part["outcome"] != "settled"]
    for outcome, (colour, marker) in style.OUTCOMES.items():
        rows = failed[failed["outcome"] == outcome]
        if len(rows):
            look = {"markersize": 4, "markeredgewidth": 0.4, "markeredgecolor": style.PAPER, "linestyle": "none"}
            axes.plot(np.degrees(rows["alpha0"]), np.degrees(rows["gamma0"]), marker, color=colour, zorder=3, **look)
    for edge in (-90, 90):
        axes.axvline(edge, color=style.INK, linewidth=0.9, linestyle=style.DASHED)
    axes.set(xlim=(-180, 180), ylim=(-180, 180), xticks=[-90, 0, 90], yticks=[-180, -90, 0, 90, 180])
    axes.set_aspect("equal")
    return len(failed)
