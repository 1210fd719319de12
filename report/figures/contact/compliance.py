"""The page on compliance: the axis about which a hand yields, by the paper's force control and by accelerations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.colors import Normalize

from report.figures.contact import rows as controllers
from report.figures.contact.hand_axes import ORDER, axes_of_turning, measured, shown_arm, turns
from report.figures.contact.rows import level, of
from report.figures.kit import style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import Run
from report.figures.kit.spelling import power

PROBE = "wrench-probe"
ORDERS = ("about x", "about y", "about z", "about x and y", "about y and z", "about z and x")
DRAWN = {controllers.EULER: "Euler Jacobian, Z-Y-X", controllers.ZYZ: "Euler Jacobian, Z-Y-Z"}

MOST_WRITTEN = 20  # columns up to which a cell says its number
DARK_FROM = 50.0  # degrees: from here on the map is light, and words on it dark
LOST, FAILED = "lost", "×"


def facts(run: Run) -> dict:
    """Return the numbers of the probe."""
    rows = controllers.of_task(run, PROBE)
    return {
        "axes_arm": shown_arm(rows),
        **measured(turns(rows)),
        "off_by_accelerations": off_by_accelerations(rows),
        "kf": f"{of(rows, controllers.PAPERS_EULER)['kf'].iloc[0]:g}",
    }


def off_by_accelerations(rows: pd.DataFrame) -> str:
    """Return how far the Euler hand's misalignment is from beta [deg], about x and y complying by accelerations."""
    own = level(of(rows, controllers.EULER, ORDER))
    own = own[own["outcome"] == "done"]
    return power(float((np.degrees(own["misalignment_rad"]) - own["beta_deg"].abs()).abs().max()))


def figures(run: Run) -> dict:
    """Return the axes of turning, and the map of frames."""
    probe = controllers.of_task(run, PROBE)
    return {"compliance-axes": axes_of_turning(probe), "compliance-map": misalignment(probe)}


def cells(rows: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Misalignment [deg] and what a cell says: a line an order, a column a beta; the worst of the arms."""
    orders = [order for order in ORDERS if order in set(rows["complies"])]
    betas = sorted(set(rows["beta_deg"]))
    values, words = pd.DataFrame(np.nan, orders, betas), pd.DataFrame("", orders, betas)
    for (order, beta), own in rows.groupby(["complies", "beta_deg"]):
        done = (own["outcome"] == "done").all()
        angle = float(np.degrees(own["misalignment_rad"].max(skipna=False)))
        values.loc[order, beta] = angle if done else np.nan
        words.loc[order, beta] = FAILED if not done else LOST if np.isnan(angle) else f"{angle:.0f}"
    return values, words


@responsive_picture
def misalignment(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw how far the hand turns away from the moment on it: a line an order, a column a frame of the hand.

    Args:
        rows: of wrench-probe.
    """
    shown = [one for one in DRAWN if one in set(rows["contender"])]
    orders = sum(name in set(rows["complies"]) for name in ORDERS)
    height = len(shown) * (0.27 * orders + 0.85) + 0.95
    figure, grid = style.panels(len(shown), 1, height=height, narrow=narrow, squeeze=False)
    said = []
    for contender, (axes,) in zip(shown, grid, strict=True):
        values, words = cells(level(of(rows, contender)))
        image = draw_cells(axes, values, words, narrow)
        axes.set_title(DRAWN[contender], fontweight="normal")
        measured = values.dropna(how="all")
        span = "; ".join(f"{order} {row.min():.0f} to {row.max():.0f}" for order, row in measured.iterrows())
        said.append(f"{DRAWN[contender]}: {span}.")
    bar = figure.colorbar(image, ax=grid[:, 0].tolist(), location="bottom", shrink=0.8 if narrow else 0.6, aspect=36)
    bar.set_label("moment to axis turned about [deg]")
    bar.outline.set_visible(False)
    return figure, f"Angle between moment and rotation in degrees. {' '.join(said)}"


def draw_cells(axes: Any, values: pd.DataFrame, words: pd.DataFrame, narrow: bool) -> Any:
    """Draw a cell an order and beta, with its number where there is room."""
    columns = len(values.columns)
    image = axes.imshow(
        values, extent=(0, columns, len(values), 0), norm=Normalize(0.0, 90.0), aspect="auto", interpolation="none"
    )
    if columns <= MOST_WRITTEN:
        for i, k in np.ndindex(values.shape):
            value = values.iat[i, k]
            ink = style.MUTED if np.isnan(value) else style.ON_COLOUR if value > DARK_FROM else "#ffffff"
            look = {"ha": "center", "va": "center", "fontsize": 6.5 if narrow else 8.5, "color": ink}
            axes.text(k + 0.5, i + 0.5, words.iat[i, k], **look)
    step = max(1, -(-columns // (10 if narrow else MOST_WRITTEN)))
    ticks = range(0, columns, step)
    axes.set(xlabel="β [deg]")
    axes.set_xticks(
        [k + 0.5 for k in ticks], [f"{values.columns[k]:.0f}" for k in ticks], fontsize=7.5 if narrow else 9
    )
    axes.set_yticks(np.arange(len(values)) + 0.5, values.index)
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[["left", "bottom"]].set_visible(False)
    return image
