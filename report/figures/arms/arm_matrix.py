"""Which controller settles from which starts on arms: a bar and a number in every cell, all arms together."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture

BAR = 0.86
"""Length of a full bar, of a cell."""


@responsive_picture
def matrix(rows: pd.DataFrame, narrow: bool):
    """Share that settles, a row a controller, a column a start set.

    Args:
        rows: of `arm_rows.episodes`, by the standard inverse.
    """
    controllers = arm_rows.in_order(rows)
    sets = [name for name in arm_rows.SETS if name in set(rows["start_set"])]
    figure, axes = style.panels(height=(0.5 if narrow else 0.42) * len(controllers) + 0.7, narrow=narrow)
    said = []
    for i, controller in enumerate(controllers):
        own = rows[rows["controller"] == controller]
        colour = style.look(controller).colour
        title = arm_rows.title(controller)
        shares = []
        for k, name in enumerate(sets):
            here = arm_rows.settled(own[own["start_set"] == name])
            if here.empty:
                continue
            share = float(here.mean())
            axes.barh(i + 0.2, BAR, left=k, height=0.2, color=style.GRID)
            axes.barh(i + 0.2, BAR * share, left=k, height=0.2, color=colour)
            axes.text(k, i + 0.06, f"{100 * share:.0f}", ha="left", va="bottom", fontsize=9)
            shares.append(f"{name} {100 * share:.0f}")
        if narrow:
            axes.text(0.0, i - 0.28, title, ha="left", va="bottom", fontsize=9, fontweight="bold", color=colour)
        said.append(f"{title}: {', '.join(shares)}")
    axes.set_yticks([] if narrow else range(len(controllers)), [] if narrow else map(arm_rows.title, controllers))
    starts = rows.groupby("start_set")[["arm", "start_id"]].apply(lambda part: len(part.drop_duplicates()))
    heads = [f"{name}\n{starts[name]}" for name in sets]
    axes.set_xticks([k + (0.0 if narrow else 0.02) for k in range(len(sets))], heads, ha="left", fontsize=8.5)
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.set(xlim=(-0.05, len(sets)), ylim=(len(controllers) - 0.4, -0.75 if narrow else -0.5))
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    return figure, f"Share that settles in per cent, all arms together. {'. '.join(said)}."


def by_arm(rows: pd.DataFrame) -> html.Html:
    """The same numbers for each arm, a folded table each."""
    parts = []
    for arm in arm_rows.arms(rows):
        own = rows[rows["arm"] == arm]
        lines = []
        for controller in arm_rows.in_order(own):
            mine = own[own["controller"] == controller]
            shares = mine.assign(settled=arm_rows.settled(mine)).groupby("start_set")["settled"].mean()
            line = {name: f"{100 * shares[name]:.0f}" for name in arm_rows.SETS if name in shares}
            lines.append({"Settled [%]": arm_rows.title(controller), **line})
        starts = len(own[["start_set", "start_id"]].drop_duplicates())
        parts.append(folded(f"{arm}, {starts} starts a controller", pd.DataFrame(lines)))
    return html.Html("".join(parts))


def folded(summary: str, frame: pd.DataFrame) -> str:
    """A table behind a line that opens it."""
    return (
        f'<details class="columns"><summary>{summary}</summary>'
        f'<div class="card-costs" tabindex="0">{html.plain_table(frame)}</div></details>'
    )
