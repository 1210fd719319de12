"""How far killed runs had come: kills by the files that were finished, a panel for what was killed."""

from __future__ import annotations

from collections import Counter
from typing import Any

from matplotlib.ticker import MaxNLocator

from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.tool.survival import KILLED, NOT_RUN, files_done

COLOUR = "#0072b2"


@responsive_picture
def moments(found: dict[str, Any], *, narrow=False):
    """Bars of the kills at each count of finished units and tables; the words alone if there were none.

    Args:
        found: survival.study().
    """
    if not found["kills"]:
        figure, axes = style.panels(height=0.6, narrow=narrow)
        axes.axis("off")
        axes.text(0.5, 0.5, NOT_RUN.replace(": ", ":\n"), ha="center", va="center", color=style.MUTED)
        return figure, f"{NOT_RUN}."
    units, tables = found["units"], found["tables"]
    grid = (3, 1) if narrow else (1, 3)
    figure, panels = style.panels(*grid, height=5.2 if narrow else 2.4, narrow=narrow, sharex=True)
    told = []
    for axes, (what, words) in zip(panels, KILLED.items(), strict=True):
        done = [files_done(one, units) for one in found["kills"] if one["killed"] == what]
        counts = Counter(done)
        axes.bar(list(counts), list(counts.values()), width=0.8, color=COLOUR)
        axes.axvline(units - 0.5, color=style.MUTED, linewidth=1.0, linestyle=style.DASHED)
        axes.set_title(words)
        axes.set_xlim(-0.8, units + tables + 0.8)
        axes.xaxis.set_major_locator(MaxNLocator(5, integer=True))
        axes.yaxis.set_major_locator(MaxNLocator(4, integer=True))
        axes.grid(visible=False, axis="x")
        among = sum(0 < k < units for k in done)
        told.append(f"{words}: {len(done)} kills, {among} of them after the first unit and before the last")
    (panels[-1] if narrow else panels[1]).set_xlabel("Files finished before the kill")
    (panels[1] if narrow else panels[0]).set_ylabel("Kills")
    return figure, f"{'; '.join(told)}. Of {units} units and {tables} tables."
