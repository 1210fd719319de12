"""How far the hand turns away from the moment on it, over the hand's frames and over the compliant axes."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.colors import Normalize

from report.figures.contact.rows import ORDERS, level, of, title
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

MOST_WRITTEN = 20  # columns up to which a cell says its number
DARK_FROM = 50.0  # degrees: from here on the map is light, and words on it dark
LOST, FAILED = "lost", "×"


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
def misalignment(rows: pd.DataFrame, contenders: tuple[str, ...], narrow: bool):
    """Return a panel a controller; a line an order, a column a frame of the hand.

    Args:
        rows: of wrench-probe. contenders: the controllers to show.
    """
    shown = [one for one in contenders if one in set(rows["contender"])]
    orders = sum(name in set(rows["complies"]) for name in ORDERS)
    height = len(shown) * (0.27 * orders + 0.85) + 0.95
    figure, grid = style.panels(len(shown), 1, height=height, narrow=narrow, squeeze=False)
    words, image = [], None
    for contender, (axes,) in zip(shown, grid, strict=True):
        values, cell_words = cells(level(of(rows, contender)))
        image = _panel(axes, values, cell_words, narrow)
        name = title(contender.partition("+")[0])
        axes.set_title(name, fontweight="normal")
        measured = values.dropna(how="all")
        span = "; ".join(f"{order} {row.min():.0f} to {row.max():.0f}" for order, row in measured.iterrows())
        words.append(f"{name}: {span}.")
    bar = figure.colorbar(
        image, ax=[axes for (axes,) in grid], location="bottom", shrink=0.8 if narrow else 0.6, aspect=36
    )
    bar.set_label("moment to axis turned about [deg]")
    bar.outline.set_visible(False)
    return figure, f"Angle between moment and rotation in degrees. {' '.join(words)}"


def _panel(axes, values: pd.DataFrame, words: pd.DataFrame, narrow: bool):
    columns, size = len(values.columns), (0, len(values.columns), len(values), 0)
    look = {"norm": Normalize(0.0, 90.0), "aspect": "auto", "interpolation": "none"}
    image = axes.imshow(values, extent=size, **look)
    step = max(1, -(-columns // (10 if narrow else MOST_WRITTEN)))
    ticks = {k + 0.5: f"{beta:.0f}" for k, beta in enumerate(values.columns) if k % step == 0}
    if columns <= MOST_WRITTEN:
        _write(axes, values, words, 6.5 if narrow else 8.5)
    axes.set(xlabel="β [deg]")
    axes.set_xticks(list(ticks), list(ticks.values()), fontsize=7.5 if narrow else 9)
    axes.set_yticks(np.arange(len(values)) + 0.5, values.index)
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[["left", "bottom"]].set_visible(False)
    return image


def _write(axes, values: pd.DataFrame, words: pd.DataFrame, size: float) -> None:
    for i, order in enumerate(values.index):
        for k, beta in enumerate(values.columns):
            value = values.loc[order, beta]
            ink = style.MUTED if np.isnan(value) else style.ON_COLOUR if value > DARK_FROM else "#ffffff"
            word = words.loc[order, beta]
            axes.text(k + 0.5, i + 0.5, word, ha="center", va="center", fontsize=size, color=ink)
