"""The page on cost: operations of each law, the printed form beside the lean one, a law's share of a controller."""

import functools
import json
import math
from pathlib import Path
from textwrap import fill
from typing import Any

import pandas as pd

from bench.experiments.tables.run import FREE_BODY, Run, require_rows
from bench.experiments.tables.store import read_arrow
from bench.findings.claims.adequacy import CALLS
from bench.findings.claims.standing import MEASURABLE
from bench.findings.selection.tables import ticks
from bench.law.contenders.registry import all_contenders
from report.figures.kit import families, html, laws, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX
from report.figures.kit.page import in_run

LEAN = {"lean": FEEDBACK, "literal": next(one.name for one in all_contenders() if one.regulator.costing_only)}
"""The linearizing law as we write it and as it is printed."""

PAPERS_ORDER = (MATRIX, LINEARIZED, FEEDBACK)
"""The paper's laws in the order in which it says that their cost grows (C12)."""

LATER = ("quaternion-shortest", "mrp", "hybrid", "mrp-memory")
"""Later laws beside them: the usual one and the ones of the answer."""

NARROW_LETTERS = 20


@functools.cache
def costs(run: Run) -> pd.DataFrame:
    """Return operations of all laws of the free body."""
    return run.rows("costs", **FREE_BODY)


def facts(run: Run) -> dict[str, Any]:
    """Return operations, the literal form against the lean, shares of a controller's time, and the machine of times."""
    return {
        **(in_run(lambda: compare_forms(totals(costs(run)))) or {}),
        **(in_run(lambda: share_of_time(run)) or {}),
        "measurable": f"{100 * MEASURABLE:g}",
        "timed_on": describe_machine(run),
        "finding": in_run(lambda: describe_order(count_operations(costs(run)))),
        "operations": in_run(lambda: draw_operations(count_operations(costs(run)))),
    }


def compare_forms(counted: pd.DataFrame) -> dict[str, int]:
    """Count flops, calls and divisions of the linearizing law, lean and as printed."""
    values = {}
    for key, name in LEAN.items():
        spent_by = counted.loc[name]
        values[f"{key}_flops"], values[f"{key}_div"] = int(spent_by["flops"]), int(spent_by["div"])
        values[f"{key}_calls"] = int(spent_by[list(CALLS)].sum())
    return values


def share_of_time(run: Run) -> dict[str, str]:
    """Return the shares of a controller's time that the cheapest law, late braking and the most expensive take."""
    shares = {law: value for law, value in ticks(run).items() if not law.endswith("literal/zyx-euler")}
    share = require_rows(shares, "time of a law")
    most = max(share, key=lambda law: share[law])
    shown = {"time_matrix": MATRIX, "time_late": "late-braking", "time_most": most}
    words = {
        key: f"{share[law]:.2g}\N{NO-BREAK SPACE}%" if law in share else html.MISSING for key, law in shown.items()
    }
    return words | {"time_most_law": families.word(most), "paper_order": order_papers_laws(share)}


def order_papers_laws(share: dict[str, float]) -> str:
    """State which of the paper's laws takes least time alone and which most, and whether the paper says so too."""
    least, _, most = sorted((MATRIX, LINEARIZED, FEEDBACK), key=lambda law: share.get(law, math.nan))
    agrees = "as" if (least, most) == (MATRIX, FEEDBACK) else "other than"
    names = f"{families.word(least)} is the cheapest and {families.word(most)} is the most expensive"
    return f"Among Murphy's three laws, {names}, {agrees} the paper says"


def timings(run: Run) -> list[Path]:
    """Return the files of times, one for each kind of machine."""
    return sorted(run.timings_folder.glob("*.parquet"))


def describe_machine(run: Run) -> str:
    """State on which machine laws were timed, and when; or that there is no timing yet."""
    paths = timings(run)
    if not paths:
        return "No law has been timed yet (`make time` does)."
    table = read_arrow(paths[0], "timings")
    about, rounds = json.loads(table.schema.metadata[b"about"]), max(table["passes"].to_pylist())
    return (
        f"We measured the times on a computer with {about['cores']} cores ({about['cpu']}) on {about['date'][:10]}, "
        f"in {rounds} rounds."
    )


def totals(counted: pd.DataFrame) -> pd.DataFrame:
    """Return the row "total" of every contender's typical branch, by contender."""
    return counted[(counted["branch"] == "typical") & (counted["stage"] == "total")].set_index("contender")


def count_operations(counted: pd.DataFrame) -> pd.DataFrame:
    """Return flops and calls of the laws that are drawn, by contender: the paper's in its order, later ones, yours."""
    rows = totals(counted)
    yours = [law for law in rows.index if (found := laws.contender(law)) and found.regulator.origin]
    shown = [law for law in (*PAPERS_ORDER, *LATER, *yours) if law in rows.index]
    rows = require_rows(rows.loc[shown], "cost of a law")
    return pd.DataFrame({"flops": rows["flops"], "calls": rows[list(CALLS)].sum(axis=1)}).astype(int)


def describe_order(operations: pd.DataFrame) -> str:
    """Say what the paper's laws cost in its order, and whether each costs more than the one before."""
    papers = operations.loc[[law for law in PAPERS_ORDER if law in operations.index]]
    total = papers.sum(axis=1)
    if len(papers) < len(PAPERS_ORDER):
        return "Murphy's order of cost is not tested in this run."
    agrees = "rises" if total.is_monotonic_increasing and total.is_unique else "does not rise"
    counts = ", ".join(f"{families.word(law)} {name_counts(*papers.loc[law])}" for law in papers.index)
    return f"The number of operations per control step {agrees} in Murphy's order: {counts}."


def name_counts(flops: int, calls: int) -> str:
    """Write flops and calls with their nouns, for a sentence."""
    return f"{flops} flops and {calls} calls" if calls else f"{flops} flops"


def count_words(flops: int, calls: int) -> str:
    """Write flops, and calls of transcendental functions where there are any: 43, or 45 + 6 calls."""
    return f"{flops} + {calls} calls" if calls else str(flops)


@responsive_picture
def draw_operations(operations: pd.DataFrame, *, narrow: bool = False) -> Drawing:
    """Draw a bar a law, in the paper's order and then the later ones: flops in colour, calls of functions outlined."""
    figure, axes = style.panels(height=0.7 + (0.5 if narrow else 0.34) * len(operations), narrow=narrow)
    names = []
    for place, (law, (flops, calls)) in enumerate(operations.iterrows()):
        colour = style.look(str(law)).colour
        axes.barh(place, flops, 0.62, color=colour)
        axes.barh(place, calls, 0.62, flops, color=style.PAPER, edgecolor=colour, linewidth=1.2)
        axes.text(flops + calls + 1.0, place, count_words(flops, calls), va="center", fontsize=9.5)
        name = laws.title(str(law))
        if law in PAPERS_ORDER:
            name = f"{PAPERS_ORDER.index(str(law)) + 1}. {name}"
        names.append(fill(name, NARROW_LETTERS) if narrow else name)
    papers = sum(law in PAPERS_ORDER for law in operations.index)
    axes.axhline(papers - 0.5, color=style.MUTED, linewidth=0.7, linestyle=style.DOTTED)
    across = axes.get_yaxis_transform()  # the line's place along the axis of laws, and the right edge
    axes.text(1.0, papers - 0.47, "since 1988", va="top", ha="right", fontsize=9, color=style.MUTED, transform=across)
    axes.set_yticks(range(len(operations)), names)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.3 * operations.sum(axis=1).max())
    axes.set_xlabel("operations per control step")
    style.listed(axes)
    said = "; ".join(f"{name} {count_words(*row)}" for name, row in zip(names, operations.to_numpy(), strict=True))
    return figure, f"Operations per control step, one bar a law: {' '.join(said.split())}."
