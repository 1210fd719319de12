"""The answer as tables: what to use for what, every criterion of every law, and what topology allows."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.findings.claims.adequacy import CALL_PRICE, CALL_PRICES, DEAR, PAPERS, exact
from bench.findings.selection.criteria import BY_NAME, Criterion
from bench.findings.selection.front import front
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import CONTINUOUS, EVERYWHERE, SURE, UNHELD, Decision, has_all
from bench.tables.statistics import Estimate
from report.figures.kit import families, html

NAMED = 3
"""Laws named beside the one to use; the others are counted."""

FRONT = ("unsettled", "lost", "time", "cost")
"""Criteria whose front the table marks: coverage, speed, cost."""

SHOWN = ("lost", "time", "worst", "cost", "memory", "held", "effort", "peak", "variation")
"""Criteria of the table of all laws, beside the share that settles; with the cost, that of the dearest branch."""


def decided(every: tuple[Decision, ...]) -> html.Markdown:
    """A line a need: the law to use, the number that decides, laws as good, and the next best."""
    lines: list[dict] = []
    heads: list[str] = []
    for one in every:
        if one.need.head not in heads:
            heads.append(one.need.head)
            lines.append({"If you need": f"*{one.need.head}*"})
        lines.append({"If you need": one.need.words, **_answer(one)})
    frame = pd.DataFrame(lines).fillna("")
    return html.table(frame, words=frame.columns)


def _answer(one: Decision) -> dict:
    if one.law is None or one.number is None:
        return {"use": "no law of this run"}
    criterion = BY_NAME[one.need.by]
    cells = {"use": families.link(one.law, families.word(one.law)), "It has": told(criterion, one.number)}
    more = len(one.alike) - NAMED
    cells["As good"] = ", ".join(map(families.word, one.alike[:NAMED])) + (f" and {more} more" if more > 0 else "")
    if one.next is not None and one.next_number is not None:
        cells["Next best"] = f"{families.word(one.next)}, {told(criterion, one.next_number)}"
    cells["Judged by"] = criterion.title[:1].lower() + criterion.title[1:]
    return cells


def told(criterion: Criterion, number: Estimate) -> str:
    """A number with its unit, and its interval where it has one."""
    value, low, high = (written(criterion, part) for part in number)
    span = "" if value == low == high else f" ({low} to {high})"
    return f"{value} {criterion.unit}{span}" if criterion.unit else f"{value}{span}"


def written(criterion: Criterion, value: float) -> str:
    """A number as its criterion writes it."""
    if math.isnan(value):
        return html.MISSING
    if math.isinf(value):
        return "none" if criterion.sense < 0 else "never"
    text = criterion.form.format(value)
    return html.number(float(text)) if "e" in text or abs(value) >= 1e3 else text


def every_law(found: Measured) -> html.Markdown:
    """A row a law, a column a criterion; a dot marks the front of FRONT."""
    points = np.array([[found.number(name, law) for name in FRONT] for law in found.laws])
    ahead = dict(zip(found.laws, front(points), strict=True))
    lines: list[dict] = []
    for family in families.present(found.laws):
        lines.append({"Law": f"*{family.title}*"})
        for law, word in family.laws.items():
            settled = 100.0 - found.number("unsettled", law)
            cells = {head(BY_NAME[name]): written(BY_NAME[name], found.number(name, law)) for name in SHOWN}
            cost, dearest = found.number("cost", law), found.number("dearest", law)
            cells[head(BY_NAME["cost"])] += f" to {dearest:.0f}" if dearest != cost else ""
            mark = {"Front": "●" if ahead[law] else ""}
            lines.append({"Law": families.link(law, word), **mark, "Settles [%]": f"{settled:.4g}", **cells})
    frame = pd.DataFrame(lines).fillna("")
    return html.table(frame, words=["Law", "Front"])


def head(criterion: Criterion) -> str:
    """A column's head."""
    return f"{criterion.title} [{criterion.unit}]" if criterion.unit else criterion.title


def kinds(found: Measured) -> dict[str, list[str]]:
    """What topology tells apart -> the laws of that kind, but for the negative controls."""
    groups: dict[str, list[str]] = {
        "no memory, no jump": [],
        "no memory, jumps": [],
        "on coordinates": [],
        "memory": [],
    }
    for law in families.in_order(found.laws):
        jumps = found.number("jump", law)
        if law in families.CONTROLS or law not in found.values["held"]:
            continue
        if found.number("memory", law):
            groups["memory"].append(law)
        elif math.isnan(jumps):
            groups["on coordinates"].append(law)
        else:
            groups["no memory, no jump" if jumps < CONTINUOUS else "no memory, jumps"].append(law)
    return {kind: laws for kind, laws in groups.items() if laws}


def allowed(found: Measured) -> html.Markdown:
    """Each kind of law: how many exact half turns it leaves, and the least noise that holds it there."""
    half_turns = found.tables.directed
    half_turns = half_turns[(half_turns["start_set"] == "half-turn") & exact(half_turns)]
    lines = []
    for kind, laws in kinds(found).items():
        lost = half_turns[half_turns["contender"].isin(laws)].groupby("contender", observed=True)["lost"]
        held = [found.number("held", law) for law in laws]
        lines.append(
            {
                "Kind": kind,
                "Laws": ", ".join(map(families.word, laws)),
                "Exact half turns never left": f"{spanned(lost.sum())} of {int(lost.size().max())}",
                "Held by noise from [rad]": spanned(pd.Series(held)),
                "Settles from every start": sum(EVERYWHERE.has(found, law) for law in laws),
                "and is not held": sum(has_all(found, law, (EVERYWHERE, UNHELD)) for law in laws),
            }
        )
    return html.table(pd.DataFrame(lines))


def spanned(values: pd.Series) -> str:
    """The least and the greatest of some numbers, or the one that all are; infinite: by none that was tried."""
    low, high = values.min(), values.max()
    if math.isinf(low):
        return "none tried"
    if math.isinf(high):
        return f"{low:g}, or none tried"
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def priced(found: Measured) -> html.Markdown:
    """At each price of a call the most that is adequate by C17, and the cheapest law of each coverage."""
    lines = []
    for price in (CALL_PRICES[0], CALL_PRICE, CALL_PRICES[1]):
        least = min(found.tables.costing(law, price=price) for law in found.laws if law in PAPERS)
        line = {"A call counts as [flops]": f"{price:g}", "Adequate up to": f"{DEAR * least:.0f}"}
        for title, facts in (
            ("Cheapest that settles everywhere", SURE),
            ("and is not held by noise", (*SURE, UNHELD)),
        ):
            able = [law for law in found.laws if has_all(found, law, facts)]
            spent = {law: found.tables.costing(law, price=price) for law in able}
            best = min(spent, key=lambda law: spent[law], default=None)
            line[title] = f"{families.word(best)}, {spent[best]:.0f}" if best else html.MISSING
        lines.append(line)
    return html.table(pd.DataFrame(lines), words=["A call counts as [flops]"])
