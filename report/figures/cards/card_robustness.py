"""The strip of a law's card: at which levels of which trouble most starts still go well."""

from __future__ import annotations

import functools
import html as markup
from pathlib import Path

import pandas as pd

import tasks
from bench.tables import read
from report.figures.kit import absent
from report.figures.robustness import robustness_rows

ENOUGH = 0.95
AXES = {
    "control-rate": ("Control rate [Hz]", 1.0),
    "delay": ("Delay [ms]", 1e3),
    "attitude-noise": ("Noise on the orientation [mrad]", 1e3),
    "rate-noise": ("Noise on the rate [rad/s]", 1.0),
    "half-turn-noise": ("Worst noise at half turns [mrad]", 1e3),
    "saturation": ("Command bounded to [rad/s²]", 1.0),
    "spin": ("Initial spin [rad/s]", 1.0),
}
"""Axis -> its row's head, and what its levels are multiplied by there."""


def shares(axis: str) -> pd.DataFrame:
    """Law and level -> share of the starts that go well; empty where the run was in no trouble."""
    return _shares(axis, read.folder())


@functools.cache
def _shares(axis: str, _: Path) -> pd.DataFrame:
    if absent.robustness(axis=axis).empty:
        return pd.DataFrame()
    return robustness_rows.along(axis).groupby(["contender", "level"], observed=True)["good"].mean().unstack()


def card_strip(name: str) -> str:
    """A table, a row an axis, a cell a level; nothing for a law that was in no trouble."""
    rows = [row(axis, name) for axis in AXES if name in shares(axis).index]
    if not rows:
        return ""
    return (
        f'<div class="card-strip" tabindex="0"><p class="card-fact"><b>In trouble</b></p>'
        f"<table>{''.join(rows)}</table></div>"
    )


def row(axis: str, name: str) -> str:
    """One axis: its levels, each with its share in words."""
    head, scale = AXES[axis]
    nominal = tasks.axis(axis).nominal
    cells = "".join(
        f'<td class="{tone(share)}{" usual" if level == nominal else ""}" title="{share:.0%} go well">'
        f"{scale * level:g}</td>"
        for level, share in shares(axis).loc[name].items()
    )
    return f'<tr><th scope="row">{markup.escape(head)}</th>{cells}</tr>'


def tone(share: float) -> str:
    """The word of a cell's looks."""
    return "well" if share >= ENOUGH else "lost" if share == 0.0 else "part"
