"""The page on cost: operations of each law, the printed form beside the lean one, a law's share of a controller."""

import functools
import json
import math
from pathlib import Path
from textwrap import fill

import pandas as pd

from bench.experiments.tables import read
from bench.experiments.tables.store import read_arrow
from bench.findings.claims.standing import MEASURABLE
from bench.findings.claims.tables import some
from bench.findings.selection.tables import ticks
from bench.law.contenders.registry import all_contenders, contenders
from report.figures.kit import families, html, laws, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX
from report.figures.kit.page import Run, in_run

LEAN = {"lean": FEEDBACK, "literal": next(one.name for one in all_contenders() if one.regulator.costing_only)}
"""The linearizing law as we write it and as it is printed."""

# kind -> (columns of costs.parquet, colour, colour of the numbers on it)
KINDS = {
    "add": (("add",), style.SUMS, style.ON_COLOUR),
    "multiply": (("mul",), style.PRODUCTS, style.PAPER),
    "divide, root": (("div", "sqrt"), style.QUOTIENTS, style.ON_COLOUR),
    "transcendental": (("sin", "cos", "atan2", "acos"), style.FUNCTIONS, style.PAPER),
}
CALLS = KINDS["transcendental"][0]
NARROW_LETTERS = 20
LEAST_LABELLED = 2
"""A narrower piece of a bar has no room for its number."""


@functools.cache
def costs(run: Run) -> pd.DataFrame:
    """Operations of the paper's laws and the user's own."""
    rows = run.rows("costs", **read.FREE_BODY)
    return rows[~rows["regulator"].isin([name for name, one in contenders("regulators").items() if one.later])]


def facts(run: Run) -> dict:
    """Return operations, the literal form against the lean, shares of a controller's time, and the machine of times."""
    return {
        **(in_run(lambda: compare_forms(totals(costs(run)))) or {}),
        **(in_run(lambda: share_of_time(run)) or {}),
        "measurable": f"{100 * MEASURABLE:g}",
        "timed_on": describe_machine(run),
        "operations": in_run(lambda: operations(costs(run))),
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
    """Return the shares of a whole controller's time that the cheapest law, late braking and the dearest take."""
    shares = {law: value for law, value in ticks(run).items() if not law.endswith("literal/zyx-euler")}
    share = some(shares, "time of a law")
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
    names = f"{families.word(least)} is the cheapest and {families.word(most)} the dearest"
    return f"Among the paper's three laws {names}, {agrees} the paper says"


def timings(run: Run) -> list[Path]:
    """Return the files of times, one for each kind of machine."""
    return sorted(run.timings_folder.glob("*.parquet"))


def describe_machine(run: Run) -> str:
    """State on which machine laws were timed, and when; or that there is no timing yet."""
    paths = timings(run)
    if not paths:
        return "No law has been timed yet (`make time` does)."
    table = read_arrow(paths[0], "timings")
    about, passes = json.loads(table.schema.metadata[b"about"]), max(table["passes"].to_pylist())
    return f"Measured on {about['cpu']}, {about['cores']} cores, {about['date'][:10]}, {passes} passes."


def totals(counted: pd.DataFrame) -> pd.DataFrame:
    """Return the row "total" of every contender's typical branch, by contender."""
    return counted[(counted["branch"] == "typical") & (counted["stage"] == "total")].set_index("contender")


@responsive_picture
def operations(costs: pd.DataFrame, *, narrow: bool = False) -> Drawing:
    """Draw a bar a law, the cheapest first, in pieces by kind; the goal's stage included."""
    rows = costs[(costs["branch"] == "typical") & (costs["stage"] == "total")].set_index("contender")
    kinds = pd.DataFrame({kind: rows[list(columns)].sum(axis=1) for kind, (columns, *_) in KINDS.items()})
    kinds = kinds.loc[kinds.sum(axis=1).sort_values(kind="stable").index]
    figure, axes = style.panels(height=0.75 + (0.6 if narrow else 0.36) * len(kinds), narrow=narrow)
    least = LEAST_LABELLED * (2 if narrow else 1)
    for kind, (_, colour, ink) in KINDS.items():
        left = kinds.loc[:, :kind].sum(axis=1) - kinds[kind]
        bars = axes.barh(range(len(kinds)), kinds[kind], 0.62, left, color=colour, label=kind, edgecolor=style.PAPER)
        words = [f"{width}" if width >= least else "" for width in kinds[kind]]
        axes.bar_label(bars, words, label_type="center", fontsize=8.5, color=ink)
    names = [laws.title(name) for name in kinds.index]
    axes.set_yticks(range(len(kinds)), [fill(name, NARROW_LETTERS) for name in names] if narrow else names)
    axes.invert_yaxis()
    axes.set_xlabel("Operations a tick, typical branch")
    style.listed(axes)
    axes.legend(
        loc="lower center", bbox_to_anchor=(0.35, 1.0), ncols=2 if narrow else 4, columnspacing=1.2, handlelength=1
    )
    flops = kinds.drop(columns="transcendental").sum(axis=1)
    said = "; ".join(
        f"{name} {spent} + {calls}" for name, spent, calls in zip(names, flops, kinds["transcendental"], strict=True)
    )
    return figure, f"Operations a tick by kind, one bar a law, flops + transcendental calls: {said}."
