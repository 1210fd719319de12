"""How far the hand turns away from the moment on it, over the hand's frames and over the compliant axes."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.colors import Normalize

from report.figures.contact.rows import ORDERS, of, title
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

MOST_WRITTEN = 20  # columns up to which a cell says its number
DARK_FROM = 50.0  # degrees: from here on the map is light, and words on it dark
LOST, FAILED = "lost", "×"
GAP = 0.5  # between frames without alpha and gamma and those with them, in columns


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


def frames(rows: pd.DataFrame) -> dict[tuple[float, float], pd.DataFrame]:
    """Rows by the goal's (alpha, gamma) [deg]: the level ones, and of the others those with most orders, then rows."""
    groups = dict(list(rows.groupby(["alpha_deg", "gamma_deg"])))

    def rank(at: tuple[float, float]) -> tuple:
        own = groups[at]
        return at != (0.0, 0.0), -own["complies"].nunique(), -len(own), at

    return {at: groups[at] for at in sorted(groups, key=rank)[:2]}


@responsive_picture
def misalignment(rows: pd.DataFrame, contenders: tuple[str, ...], narrow: bool):
    """A panel a controller; a line an order, a column a frame of the hand.

    Args:
        rows: of wrench-probe. contenders: the controllers to show.
    """
    shown = [one for one in contenders if one in set(rows["contender"])]
    orders = sum(name in set(rows["complies"]) for name in ORDERS)
    height = len(shown) * (0.27 * orders + 0.85) + 0.95
    figure, grid = style.panels(len(shown), 1, height=height, narrow=narrow, squeeze=False)
    words, image = [], None
    for contender, (axes,) in zip(shown, grid, strict=True):
        own = of(rows, contender)
        tables = {key: cells(at) for key, at in frames(own).items()}
        image = _panel(axes, tables, narrow)
        name = title(contender.partition("+")[0])
        axes.set_title(name, fontweight="normal", pad=18)
        words.append(f"{name}: {_sentence(tables)}.")
    bar = figure.colorbar(
        image, ax=[axes for (axes,) in grid], location="bottom", shrink=0.8 if narrow else 0.6, aspect=36
    )
    bar.set_label("moment to axis turned about [deg]")
    bar.outline.set_visible(False)
    return figure, f"Angle between moment and rotation in degrees. {' '.join(words)}"


def _panel(axes, tables: dict, narrow: bool):
    columns = sum(len(values.columns) for values, _ in tables.values())
    step = max(1, -(-columns // (10 if narrow else MOST_WRITTEN)))
    left, image = 0.0, None
    ticks: dict[float, str] = {}
    for (alpha, gamma), (values, words) in tables.items():
        width = len(values.columns)
        image = axes.imshow(
            values,
            norm=Normalize(0.0, 90.0),
            aspect="auto",
            interpolation="none",
            extent=(left, left + width, len(values), 0),
        )
        ticks |= {left + k + 0.5: f"{beta:.0f}" for k, beta in enumerate(values.columns) if k % step == 0}
        if columns <= MOST_WRITTEN:
            _write(axes, left, values, words, 6.5 if narrow else 8.5)
        where = "α = γ = 0" if alpha == gamma == 0.0 else f"α {alpha:.0f}°, γ {gamma:.0f}°"
        axes.text(left, -0.25, where, ha="left", va="bottom", fontsize=8.5, color=style.MUTED)
        left += width + GAP
    first = next(iter(tables.values()))[0]
    axes.set(xlim=(0, left - GAP), ylim=(len(first), 0), xlabel="β [deg]")
    axes.set_xticks(list(ticks), list(ticks.values()), fontsize=7.5 if narrow else 9)
    axes.set_yticks(np.arange(len(first)) + 0.5, first.index)
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[["left", "bottom"]].set_visible(False)
    return image


def _write(axes, left: float, values: pd.DataFrame, words: pd.DataFrame, size: float) -> None:
    for i, order in enumerate(values.index):
        for k, beta in enumerate(values.columns):
            value = values.loc[order, beta]
            ink = style.MUTED if np.isnan(value) else style.ON_COLOUR if value > DARK_FROM else "#ffffff"
            word = words.loc[order, beta]
            axes.text(left + k + 0.5, i + 0.5, word, ha="center", va="center", fontsize=size, color=ink)


def _sentence(tables: dict) -> str:
    parts = []
    for (alpha, gamma), (values, _) in tables.items():
        measured = values.dropna(how="all")
        span = "; ".join(f"{order} {row.min():.0f} to {row.max():.0f}" for order, row in measured.iterrows())
        parts.append(f"alpha {alpha:.0f}, gamma {gamma:.0f}: {span}")
    return "; ".join(parts)
