"""What failed episodes on arms were near, by the judge: stacked bars, a controller each."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture

# cause -> colour, in the order in which they are stacked
COLOURS = {
    "representation": "#cc79a7",
    "both": "#a39400",
    "kinematic": "#56b4e9",
    "torque": "#e69f00",
    "law": "#000001",
}
MEANINGS = {
    "representation": "the coordinates came near their singular set",
    "both": "near a singularity of the coordinates and of the arm",
    "kinematic": "the arm came near a singularity of its own",
    "torque": "near neither, as far as was seen; the torque or the speed left all bounds",
    "law": "none of these: a dead point, or a jump of the coordinates",
}
LEAST_SHOWN = 0.1
"""The axis reaches at least this share, also where nothing fails."""


@responsive_picture
def causes(rows: pd.DataFrame, narrow: bool):
    """Share of all episodes that fail, by cause.

    Args:
        rows: of `arm_rows.episodes`, by the standard inverse.
    """
    controllers = arm_rows.in_order(rows)
    figure, axes = style.panels(height=(0.44 if narrow else 0.33) * len(controllers) + 1.2, narrow=narrow)
    counts = tallied(rows)
    widest = max(LEAST_SHOWN, float(counts[list(COLOURS)].sum(axis=1).div(counts["n"]).max()))
    said = []
    for i, controller in enumerate(controllers):
        line, left = counts.loc[controller], 0.0
        for cause, colour in COLOURS.items():
            share = float(line[cause] / line["n"])
            axes.barh(i + (0.14 if narrow else 0.0), 100 * share, left=100 * left, height=0.5, color=colour)
            left += share
        axes.text(100 * left + 0.8, i + (0.14 if narrow else 0.0), f"{100 * left:.0f}", va="center", fontsize=9)
        title = arm_rows.title(controller)
        if narrow:
            axes.text(0.0, i - 0.16, title, ha="left", va="bottom", fontsize=9)
        told = ", ".join(f"{int(line[cause])} {cause}" for cause in COLOURS if line[cause])
        said.append(f"{title}: {told or 'none'} of {int(line['n'])}")
    for cause, colour in COLOURS.items():
        if counts[cause].sum():
            axes.barh([0], [0], color=colour, label=cause)
    axes.set_yticks([] if narrow else range(len(controllers)), [] if narrow else map(arm_rows.title, controllers))
    axes.set(xlabel="episodes that fail [%]", xlim=(0, 108 * widest), ylim=(len(controllers) - 0.4, -0.75))
    style.listed(axes)
    if counts[list(COLOURS)].to_numpy().any():
        figure.legend(loc="outside lower center", ncols=3 if narrow else 5)
    return figure, f"Failed episodes by cause. {'. '.join(said)}."


def tallied(rows: pd.DataFrame) -> pd.DataFrame:
    """Failed episodes by cause, and n: a row a controller."""
    failed = rows[~arm_rows.settled(rows)]
    counts = pd.crosstab(failed["controller"], failed["cause"].astype(str))
    counts = counts.reindex(index=arm_rows.in_order(rows), columns=list(COLOURS), fill_value=0)
    return counts.assign(n=rows.groupby("controller").size())


def key(cause: str) -> str:
    """A cause with the colour it has in the figure."""
    return f'<span class="key" style="--key: {html.both(COLOURS[cause])}"></span>{cause}'
