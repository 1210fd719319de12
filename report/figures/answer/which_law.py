"""The page that says which law to use: for what, by which criteria, and on arms."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.experiments.suites import BEST
from bench.findings.claims import Results, judge
from bench.findings.claims.adequacy import CALL_PRICE, CALL_PRICES
from bench.findings.claims.later import HELD_RAD
from bench.findings.selection import needs
from bench.findings.selection.criteria import BY_NAME, Criterion
from bench.findings.selection.front import front
from bench.findings.selection.measured import Measured, measured
from bench.tables import read
from bench.tables.statistics import Estimate
from report.figures.answer.plane import plane, shown
from report.figures.arms import arm_rows
from report.figures.comparison.cells import by_family
from report.figures.kit import families, html
from report.figures.kit.laws import TITLES
from report.figures.kit.page import Run
from report.figures.kit.rows import small_error_settling_s

NAMED = 3
"""Laws named beside the one to use; the others are counted."""

FRONT = ("unsettled", "lost", "time", "cost")
"""Criteria whose front the table marks: coverage, speed, cost."""

SHOWN = ("lost", "time", "worst", "cost", "memory", "held", "effort", "peak", "variation")
"""Criteria of the table of all laws, beside the share that settles; with the cost, that of the dearest branch."""


def facts(run: Run) -> dict:
    """The answer in a few sentences, and the numbers about it."""
    found = measured(run.folder)
    whole = [law for law in shown(found) if needs.EVERYWHERE.has(found, law)]
    forgetful = [law for law in shown(found) if not found.number("memory", law) and law in found.values["held"]]
    verdict = judge("C27", Results(run.folder))
    return {
        "lead": lead(run),
        "laws": len(shown(found)),
        "tried": sum(needs.TRIED.has(found, law) for law in shown(found)),
        "whole": len(whole),
        "unheld": sum(needs.UNHELD.has(found, law) for law in whole),
        "uniform": len(found.values["time"][found.laws[0]]),
        "directed": len(found.tables.directed) // len(found.laws),
        "noise": f"{HELD_RAD:g}",
        "price": CALL_PRICE,
        "low": CALL_PRICES[0],
        "high": CALL_PRICES[1],
        "cheapest_low": cheapest(found, CALL_PRICES[0]),
        "cheapest_high": cheapest(found, CALL_PRICES[1]),
        "band": f"{100 * float(found.tables.uniform['tolerance'].iloc[0]):g}",
        "rate": f"{1 / float(found.tables.uniform['dt_s'].iloc[0]):g}",
        "forgetful": len(forgetful),
        "forgetful_both": sum(needs.has_all(found, law, (needs.EVERYWHERE, needs.UNHELD)) for law in forgetful)
        or "none",
        "verdict": str(verdict.word),
        **{key: verdict.evidence.parts[key] for key in ("nearly", "adequate", "answers")},
        **on_arms(run),
    }


def on_arms(run: Run) -> dict:
    """How many later laws ran on arms, and of all laws the one that settles most and the one that settles least.

    Over episodes of the paper's three and of the best later laws by the geometric Jacobian and the standard inverse.
    """
    every = arm_rows.episodes(run)
    laws = [*TITLES, *(word.partition("@")[0] for word in BEST)]
    by_standard = every["way"] == every["law"] + f"@geometric+{arm_rows.STANDARD}"
    found = every[by_standard & every["law"].isin(laws)]
    shares = arm_rows.settled(found).groupby(found["law"]).mean()
    later = shares[[law for law in shares.index if law not in TITLES]]
    return {
        "arms": found["arm"].nunique(),
        "arm_laws": len(later),
        "arm_starts": len(found) // max(1, len(shares)),
        "arm_most": families.word(str(shares.idxmax())),
        "arm_most_share": f"{100 * shares.max():.0f}",
        "arm_least": families.word(str(shares.idxmin())),
        "arm_least_share": f"{100 * shares.min():.0f}",
        "arm_alike": "all alike"
        if later.nunique() <= 1
        else f"from {100 * later.min():.0f} to {100 * later.max():.0f} %",
    }


def front_page(run: Run) -> str:
    """The answer in one sentence."""
    found, law = measured(run.folder), the_answer(run).law
    if law is None:
        return f"No law of this run settles from every start tried and is held by no noise up to {HELD_RAD:g} rad."
    settled = told(BY_NAME["time"], found.estimate("time", law))
    return (
        f"Of {len(shown(found))} laws {families.word(law)} is the cheapest that settles from every start tried and "
        f"that no noise up to {HELD_RAD:g} rad holds at a half turn: {found.number('cost', law):.0f} operations a "
        f"tick, and 99 % of all starts settled in {settled}."
    )


def lead(run: Run) -> str:
    """The same; what the next costs, and how many needs it answers."""
    every, answer = needs.decisions(run.folder), the_answer(run)
    if answer.law is None:
        least = families.word(every[0].law) if every[0].law else "no law of this run"
        return f"{front_page(run)} The cheapest that settles from every start is {least}."
    beside = f" The next costs {answer.next_number.value:.0f}." if answer.next_number else ""
    wins = sum(answer.law == one.law or answer.law in one.alike for one in every)
    return f"{front_page(run)}{beside} In {wins} of {len(every)} needs below it is the best or among equals."


def the_answer(run: Run) -> needs.Decision:
    """The law to use where nothing else is said."""
    return next(one for one in needs.decisions(run.folder) if one.need is needs.ANSWER)


def cheapest(found: Measured, price: float) -> str:
    """The cheapest law that settles everywhere and is not held, where a call counts as so many flops."""
    asked = [law for law in found.laws if needs.has_all(found, law, (*needs.SURE, needs.UNHELD))]
    return families.word(min(asked, key=lambda law: found.tables.costing(law, price=price))) if asked else "none"


def tables(run: Run) -> dict:
    """Needs, and all laws."""
    return {"decided": decided(needs.decisions(run.folder)), "laws_table": every_law(measured(run.folder))}


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


def figures(run: Run) -> dict:
    """Cost against settling time."""
    small = small_error_settling_s(run.rows("episodes", engine="ideal-rk4", **read.FREE_BODY))
    return {"answer-plane": plane(measured(run.folder), small)}
