"""The page that says which law to use: for what, by which criteria, what topology allows, and on arms."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.findings.claims import Results, judge
from bench.findings.claims.adequacy import CALL_PRICE, CALL_PRICES, DEAR, PAPERS, exact
from bench.findings.claims.later import HELD_RAD
from bench.findings.selection import needs
from bench.findings.selection.criteria import BY_NAME, Criterion
from bench.findings.selection.front import front
from bench.findings.selection.measured import Measured, measured
from bench.tables import read
from bench.tables.statistics import Estimate
from report.figures.answer import on_arms
from report.figures.answer.plane import plane
from report.figures.comparison.cells import by_family
from report.figures.kit import families, html
from report.figures.kit.page import Run
from report.figures.kit.rows import small_error_settling_s
from report.figures.kit.tables import Table

NAMED = 3
"""Laws named beside the one to use; the others are counted."""

FRONT = ("unsettled", "lost", "time", "cost")
"""Criteria whose front the table marks: coverage, speed, cost."""

SHOWN = ("lost", "time", "worst", "cost", "memory", "held", "effort", "peak", "variation")
"""Criteria of the table of all laws, beside the share that settles; with the cost, that of the dearest branch."""

KINDS = Table(
    "Kind | Laws | Exact half turns never left | Held by noise from [rad] | Settles from every start | and is not held"
)
PRICES = Table(
    "A call counts as [flops] | Adequate up to | Cheapest that settles everywhere | and is not held by noise"
)


def facts(run: Run) -> dict:
    """The answer in a few sentences, and the numbers about it."""
    found, every = measured(run.folder), needs.decisions(run.folder)
    able = [law for law in found.laws if law not in families.CONTROLS]
    whole = [law for law in able if needs.EVERYWHERE.has(found, law)]
    forgetful = [law for law in able if not found.number("memory", law) and law in found.values["held"]]
    verdict = judge("C27", Results(run.folder))
    return {
        "lead": lead(found, every),
        "laws": len(able),
        "tried": sum(needs.TRIED.has(found, law) for law in able),
        "whole": len(whole),
        "unheld": sum(needs.UNHELD.has(found, law) for law in whole),
        "uniform": len(found.values["time"][found.laws[0]]),
        "directed": len(found.tables.directed) // len(found.laws),
        "noise": f"{HELD_RAD:g}",
        "price": CALL_PRICE,
        "band": f"{100 * float(found.tables.uniform['tolerance'].iloc[0]):g}",
        "rate": f"{1 / float(found.tables.uniform['dt_s'].iloc[0]):g}",
        "forgetful": len(forgetful),
        "forgetful_both": sum(needs.has_all(found, law, (needs.EVERYWHERE, needs.UNHELD)) for law in forgetful)
        or "none",
        "verdict": str(verdict.word),
        **{key: verdict.evidence.numbers[key] for key in ("nearly", "adequate", "answers")},
        **on_arms.facts(on_arms.rows(run)),
    }


def lead(found: Measured, every: tuple[needs.Decision, ...]) -> str:
    """The whole answer in a few sentences."""
    answer = next(one for one in every if one.need is needs.ANSWER)
    if answer.law is None:
        cheapest = families.word(every[0].law) if every[0].law else "no law of this run"
        return (
            f"No law of this run both settles from every start and is held at a half turn by no noise up to "
            f"{HELD_RAD:g} rad. The cheapest that settles from every start is *{cheapest}*."
        )
    law = answer.law
    wins = sum(law == one.law or law in one.alike for one in every)
    beside = f" The next that does costs {answer.next_number.value:.0f}." if answer.next_number else ""
    return (
        f"Unless a row below says otherwise: *{families.word(law)}*. It settles from every start tried, no noise up to "
        f"{HELD_RAD:g} rad holds it at a half turn, and at {found.number('cost', law):.0f} operations a tick it is the "
        f"cheapest law of which both are true.{beside} In {wins} of {len(every)} needs below it is the best or among "
        "equals."
    )


def front_page(run: Run) -> str:
    """The answer in one sentence."""
    found = measured(run.folder)
    law = next(one.law for one in needs.decisions(run.folder) if one.need is needs.ANSWER)
    if law is None:
        return f"No law of this run settles from every start tried and is held by no noise up to {HELD_RAD:g} rad."
    times = told(BY_NAME["time"], found.estimate("time", law))
    return (
        f"Of {sum(one not in families.CONTROLS for one in found.laws)} laws {families.word(law)} is the cheapest that "
        f"settles from every start tried and that no noise up to {HELD_RAD:g} rad holds at a half turn: "
        f"{found.number('cost', law):.0f} operations a tick, and 99 % of all starts settled in {times}."
    )


def tables(run: Run) -> dict:
    """Needs, laws, kinds of laws, prices of a call, arms."""
    found = measured(run.folder)
    return {
        "decided": decided(needs.decisions(run.folder)),
        "laws_table": every_law(found),
        "allowed": KINDS(kind_of(found, kind, laws) for kind, laws in kinds(found).items()),
        "priced": PRICES(priced(found, price) for price in (CALL_PRICES[0], CALL_PRICE, CALL_PRICES[1])),
        "on_arms": on_arms.table(on_arms.rows(run)),
    }


def decided(every: tuple[needs.Decision, ...]) -> html.Markdown:
    """A line a need: the law to use, the number that decides, laws as good, and the next best."""
    lines: list[dict] = []
    heads: list[str] = []
    for one in every:
        if one.need.head not in heads:
            heads.append(one.need.head)
            lines.append({"If you need": f"*{one.need.head}*"})
        lines.append({"If you need": one.need.words, **_answer(one)})
    return html.table(pd.DataFrame(lines).fillna(""))


def _answer(one: needs.Decision) -> dict:
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


def every_law(found: Measured) -> html.Markdown | None:
    """A row a law, a column a criterion; a dot marks the front of FRONT."""
    points = np.array([[found.number(name, law) for name in FRONT] for law in found.laws])
    ahead = dict(zip(found.laws, front(points), strict=True))

    def line(law: str) -> dict:
        cells = {head(BY_NAME[name]): written(BY_NAME[name], found.number(name, law)) for name in SHOWN}
        cost, dearest = found.number("cost", law), found.number("dearest", law)
        cells[head(BY_NAME["cost"])] += f" to {dearest:.0f}" if dearest != cost else ""
        settled = f"{100.0 - found.number('unsettled', law):.4g}"
        return {"Front": "●" if ahead[law] else "", "Settles [%]": settled, **cells}

    return by_family(found.laws, line)


def head(criterion: Criterion) -> str:
    """A column's head."""
    return f"{criterion.title} [{criterion.unit}]" if criterion.unit else criterion.title


def kinds(found: Measured) -> dict[str, list[str]]:
    """What topology tells apart -> the laws of that kind, but for the negative controls."""
    groups: dict[str, list[str]] = {
        kind: [] for kind in ("no memory, no jump", "no memory, jumps", "on coordinates", "memory")
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
            groups["no memory, no jump" if jumps < needs.CONTINUOUS else "no memory, jumps"].append(law)
    return {kind: laws for kind, laws in groups.items() if laws}


def kind_of(found: Measured, kind: str, laws: list[str]) -> tuple:
    """A kind of law: how many exact half turns it leaves, and the least noise that holds it there."""
    half_turns = found.tables.directed
    half_turns = half_turns[(half_turns["start_set"] == "half-turn") & exact(half_turns)]
    lost = half_turns[half_turns["contender"].isin(laws)].groupby("contender", observed=True)["lost"]
    return (
        kind,
        ", ".join(map(families.word, laws)),
        f"{spanned(lost.sum())} of {int(lost.size().max())}",
        spanned(pd.Series([found.number("held", law) for law in laws])),
        sum(needs.EVERYWHERE.has(found, law) for law in laws),
        sum(needs.has_all(found, law, (needs.EVERYWHERE, needs.UNHELD)) for law in laws),
    )


def spanned(values: pd.Series) -> str:
    """The least and the greatest of some numbers, or the one that all are; infinite: by none that was tried."""
    low, high = values.min(), values.max()
    if math.isinf(low):
        return "none tried"
    if math.isinf(high):
        return f"{low:g}, or none tried"
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def priced(found: Measured, price: float) -> tuple:
    """At a price of a call the most that is adequate by C17, and the cheapest law of each coverage."""
    least = min(found.tables.costing(law, price=price) for law in found.laws if law in PAPERS)
    cheapest = []
    for asked in (needs.SURE, (*needs.SURE, needs.UNHELD)):
        spent = {law: found.tables.costing(law, price=price) for law in found.laws if needs.has_all(found, law, asked)}
        best = min(spent, key=lambda law: spent[law], default=None)
        cheapest.append(f"{families.word(best)}, {spent[best]:.0f}" if best else html.MISSING)
    return f"{price:g}", f"{DEAR * least:.0f}", *cheapest


def figures(run: Run) -> dict:
    """Cost against settling time."""
    small = small_error_settling_s(run.rows("episodes", engine="ideal-rk4", **read.FREE_BODY))
    return {"answer-plane": plane(measured(run.folder), small)}
