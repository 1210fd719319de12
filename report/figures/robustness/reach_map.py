"""The map of how far laws go: laws by perturbations, a cell the level at which one gives way."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Rectangle

from report.figures.kit import families, style
from report.figures.kit.inline import responsive_picture
from report.figures.robustness.reach import WALKS, Reach, is_fine

SPLIT = 7
"""Columns of the upper half on a phone."""

FAULT, FINE = "#d55e00", "#b9c3cf"


@responsive_picture
def reach_map(found: dict[str, list[Reach]], narrow: bool):
    """A cell a law and way: empty where nothing gives way, else the level at which it does.

    Args:
        found: of `reach.reaches`.
    """
    groups = families.present(found)
    lines = len(found) + 0.4 * len(groups)
    parts = [slice(0, SPLIT), slice(SPLIT, None)] if narrow else [slice(None)]
    figure, grid = style.panels(len(parts), 1, height=(0.215 * lines + 1.75) * len(parts), narrow=narrow, squeeze=False)
    for axes, part in zip(grid.flat, parts, strict=True):
        _cells(axes, groups, found, part)
    words = (
        f"{families.word(law)} gives way to {gives_way(found[law]) or 'nothing'}"
        for family in groups
        for law in family.laws
    )
    return figure, f"How far {len(found)} laws go along {len(WALKS)} ways into trouble: {'; '.join(words)}."


def _cells(axes, groups, found: dict[str, list[Reach]], part: slice) -> None:
    walks, place, names = WALKS[part], 0.0, []
    for family in groups:
        place += 0.4
        for law, word in family.laws.items():
            label = families.word(law) if word.startswith("in ") else word
            names.append((place, label, style.look(law).colour))
            for column, one in enumerate(found[law][part]):
                _cell(axes, column, place, one)
            place += 1.0
    axes.set(xlim=(0, len(walks)), ylim=(place + 0.1, 0.2))
    axes.set_xticks(np.arange(len(walks)) + 0.5, [walk.title for walk in walks], rotation=40, ha="left", fontsize=9)
    axes.xaxis.tick_top()
    axes.set_yticks([y + 0.5 for y, _, _ in names], [label for _, label, _ in names], fontsize=9)
    axes.tick_params(length=0, pad=2)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)


def _cell(axes, column: int, place: float, one: Reach) -> None:
    depth = 1.0 - one.step / max(1, one.steps)
    colour, strength = (
        (FINE, 0.35) if is_fine(one) else (style.MUTED, 0.5) if one.fails else (FAULT, 0.25 + 0.6 * depth)
    )
    axes.add_patch(Rectangle((column + 0.03, place + 0.05), 0.94, 0.9, color=colour, alpha=strength, linewidth=0))
    word = "" if is_fine(one) else "fails" if one.fails else f"{one.level:g}".removeprefix("0")
    axes.text(column + 0.5, place + 0.52, word, ha="center", va="center", fontsize=8)


def gives_way(own: list[Reach]) -> str:
    """The ways along which a law gives way, with the levels, in words."""
    parts = [
        f"{walk.words} ({'fails' if one.fails else f'at {one.level:g}'})"
        for walk, one in zip(WALKS, own, strict=True)
        if not is_fine(one)
    ]
    return ", ".join(parts)
