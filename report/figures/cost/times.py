"""Time a tick of every law alone, against its flops: how far counting carries."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd

from bench.tables.read import with_contender
from bench.tables.schema import RESULTS
from bench.tables.store import read_arrow
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

FOLDER = RESULTS / "timings"
NONE_YET = "No law has been timed on this machine yet.\nmake time   times all of them, interleaved."


def files() -> list[Path]:
    """One file a kind of machine."""
    return sorted(FOLDER.glob("*.parquet"))


def read(path: Path) -> pd.DataFrame:
    """A machine's rows with `contender` added."""
    return with_contender(read_arrow(path, "timings").to_pandas())


def alone(frame: pd.DataFrame) -> pd.DataFrame:
    """Laws timed alone, the fastest first; a law that could not be timed is left out."""
    rows = frame[(frame["what"] == "law") & (frame["ticks"] > 0)]
    return rows.sort_values("ratio", kind="stable").reset_index(drop=True)


@responsive_picture
def times(rows: pd.DataFrame, costs: pd.DataFrame, titles: dict[str, str], *, narrow=False):
    """Time in steps of the reference kernel against flops; no rows: a line that says so."""
    if rows.empty:
        return style.words(NONE_YET, narrow), " ".join(NONE_YET.split())
    figure, axes = style.panels(height=4.2 if narrow else 3.5, narrow=narrow)
    total = costs[(costs["branch"] == "typical") & (costs["stage"] == "total")].set_index("contender")
    rows = rows[rows["contender"].isin(total.index)]
    for row in rows.itertuples():
        look = style.look(row.contender)
        x = total.at[row.contender, "flops"]
        axes.plot([x, x], [row.ratio_low, row.ratio_high], color=look.colour, linewidth=1.3)
        marks = {"color": look.colour, "marker": look.marker, "linestyle": "none", "markersize": 7}
        axes.plot(x, row.ratio, label=titles.get(row.contender, row.contender), **marks)
    named = "Flops a tick, without calls" if narrow else "Flops a tick, typical branch, without transcendental calls"
    axes.set(xlabel=named, ylabel="Time a tick [kernel steps]")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    figure.legend(loc="outside upper left", ncols=1 if narrow else 3, columnspacing=1.4)
    words = "; ".join(
        f"{titles.get(row.contender, row.contender)} {total.at[row.contender, 'flops']} flops, {row.ratio:.2f} steps"
        for row in rows.itertuples()
    )
    return figure, f"Time a tick in steps of the reference kernel against flops a tick: {words}."


def said() -> str:
    """On which machine, and when; or that there is no timing yet."""
    paths = files()
    if not paths:
        return "No law has been timed yet (`make time` does)."
    about = json.loads(read_arrow(paths[0], "timings").schema.metadata[b"about"])
    passes = int(read(paths[0])["passes"].max())
    return f"Measured on {about['cpu']}, {about['cores']} cores, {about['date'][:10]}, {passes} passes."
