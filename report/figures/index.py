"""What the front page shows: who and when, an abstract, the headline figure, eight conclusions, and what to use."""

import math
import re
from collections.abc import Callable, Iterator
from typing import Any

from bench.base.errors import NoEvidence
from bench.experiments.tables.run import Run, require_rows
from bench.findings.answer import NOT_TESTED, Answer, find_answer
from bench.findings.claims import tables
from bench.findings.claims.places import EXACT_RAD
from bench.findings.claims.verdict import Word
from bench.findings.conclusions import conclude
from bench.findings.replication import compare_jacobians, measure_settling, starts_at_rest
from bench.law.attribution import IN_WORDS
from report.figures.answer import which_law
from report.figures.failures import failure_map
from report.figures.kit import families, html
from report.figures.kit.laws import LINEARIZED, MATRIX
from report.figures.kit.page import in_run
from report.figures.kit.spelling import prose
from report.figures.method.provenance import CITATION, cited
from report.figures.replication.conclusions import SHORT, call_laws, count_statements, list_in_short

NEEDS = html.PageTable("Your controller | Use | Why | Price")


def facts(run: Run) -> dict[str, Any]:
    """Return byline, abstract, headline figure, conclusions, and today's answer with its price."""
    answer = find_answer()
    return {
        "byline": describe_edition(run),
        "abstract": describe_replication(run),
        "hero": in_run(failure_map.hero_picture, run),
        "finding": in_run(lambda: failure_map.say_finding(run.rows("episodes", engine=tables.MAIN_ENGINE))),
        "conclusions": in_run(lambda: SHORT(list_in_short(run))),
        "answer": describe_answer(answer),
        "price": describe_price(answer),
        "condition": which_law.describe_condition(answer) if answer.is_tested else "It is not tested.",
        "needs": NEEDS(list_needs(answer)),
        "cite": describe_citation(),
    }


def list_authors() -> list[str]:
    """Return the authors that CITATION.cff names."""
    text = CITATION.read_text(encoding="utf-8")
    [authors] = re.findall(r"^authors:\n((?:  .*\n)+)", text, re.MULTILINE)
    return re.findall(r"name: *[\"']?([^\"'\n]+)", authors)


def describe_edition(run: Run) -> str:
    """Return authors, date, version, and the commit and the suite that the results are of."""
    found = run.provenance("suite", "commit", "dirty", "finished")
    edition = cited()
    changed = " with changes" if found["dirty"] else ""
    commit = found["commit"][:8] or "unknown"
    date = found["finished"][:10]
    return (
        f"{', '.join(list_authors())}. Version {edition['version']}, with results of {date} (suite of "
        f"simulations: {found['suite']}; commit {commit}{changed}). Everything is simulated; no hardware was used."
    )


def describe_citation() -> str:
    """Return how to cite this edition."""
    edition = cited()
    year = edition["date-released"][:4]
    return f"{', '.join(list_authors())} ({year}). *{edition['title']}.* Version {edition['version']}."


def describe_replication(run: Run) -> str:
    """Return the abstract: what the paper concluded, what was simulated, and what came out."""
    sentences = [
        "In 1988 Murphy compared three regulators (laws) for the orientation of an end effector.",
        "He concluded that no regulator combines performance with low cost, and that a Jacobian for Euler angles "
        "excludes some orientations. He also concluded that, under force control with this Jacobian, the end effector "
        "complies about the axes of the Euler angles, not about the Cartesian axes. He left open whether better "
        "regulators exist.",
    ]
    for find, otherwise in FOUND.items():
        sentences.append(in_run(find, run) or f"{otherwise} is not tested in this run.")
    return " ".join(sentences)


def describe_size(run: Run) -> str:
    """Say how much was simulated."""
    found = run.provenance("episodes", "trials", "troubled")
    episodes = found["episodes"] + found["trials"] + found["troubled"]
    arms = run.rows("episodes", task="arm-regulation")["arm"].nunique()
    return (
        f"We implemented his regulators, Jacobians and force control. We ran {html.number(episodes)} simulations of a "
        f"free body and of {arms} arms."
    )


def describe_statements(run: Run) -> str:
    """Say how many of the paper's statements hold, and how many criteria were revised."""
    counts = count_statements(run)
    return (
        f"Of his {counts['decided']} statements, {counts['words']}. We judged each statement by a criterion in "
        f"numbers, and revised {counts['changed']} of these criteria after the first results. We report the verdicts "
        f"by the original and by the revised criteria."
    )


def describe_half_turns(run: Run) -> str:
    """Say what the rotation-matrix regulator does at exact 180° rotations."""
    rows = starts_at_rest(run)
    is_exact = math.pi - rows["angle0_rad"] <= EXACT_RAD
    exact = require_rows(rows[(rows["contender"] == MATRIX) & is_exact], "exact 180° rotation")
    failed = int((~tables.settled(exact)).sum())
    if not failed:
        return f"The rotation-matrix regulator settles from all {len(exact)} starts exactly 180° from the goal."
    count = f"all {failed}" if failed == len(exact) else f"{failed} of {len(exact)}"
    return f"The rotation-matrix regulator fails from {count} initial orientations exactly 180° away from the goal."


def describe_lost(run: Run) -> str:
    """Say from how many orientations the linearized regulator fails."""
    rows = starts_at_rest(run)
    share = measure_settling(rows[rows["contender"] == LINEARIZED]).share
    lost, low, high = (f"{100 * (1.0 - settled):.1f}" for settled in (share.value, share.high, share.low))
    starts = f"{html.number(share.n)} random orientations"
    return f"The linearized regulator fails from {lost} % ({low} to {high} %) of {starts}."


def describe_pole(run: Run) -> str:
    """Say how much more torque an arm needs with Euler angles when it passes gimbal lock."""
    both = compare_jacobians(run)
    ratio = float(f"{both.harder.value:.2g}")
    return (
        f"When an arm passes gimbal lock, a controller with the Euler Jacobian needs {ratio:g} times the peak torque "
        f"of a controller with the geometric Jacobian (median of {both.moves} moves)."
    )


def describe_open(run: Run) -> str:
    """Say whether the open question is answered, and by which laws."""
    [found] = [conclusion for conclusion in conclude(run) if conclusion.name == "open-question"]
    if found.verdict == Word.UNTESTED:
        raise NoEvidence("the run does not decide the open question")
    answer = "answered" if found.verdict == Word.ANSWERED else "still open"
    first_sentence = found.finding.split(". ")[0].rstrip(".")
    return f"The question that Murphy left open is {answer}. {prose(call_laws(first_sentence))}."


FOUND: dict[Callable[[Run], str], str] = {
    describe_size: "The number of episodes",
    describe_statements: "The number of his statements that hold",
    describe_half_turns: "Whether the rotation-matrix regulator leaves a 180° error",
    describe_lost: "How often the linearized regulator fails",
    describe_pole: "The torque that an arm needs near gimbal lock",
    describe_open: "The question that he left open",
}
"""A sentence of the abstract, and the subject of the sentence that stands there if the run lacks its rows."""


def describe_answer(answer: Answer) -> str:
    """Say what to use today, whose law it is, and why."""
    if not answer.is_tested:
        return "Which law to use is not tested: the map of situations is missing."
    law = f'<a href="laws/{families.anchor(answer.law)}.html">{families.word(answer.law)}</a>'
    whose = IN_WORDS.get(answer.attribution, answer.attribution)
    return f"Use **{law}**, {whose}. {prose(call_laws(answer.reason))} {describe_test(answer)}"


def describe_test(answer: Answer) -> str:
    """Say in which situations the law was compared with others."""
    return f"The law was tested on {prose(call_laws(answer.tested))}."


def describe_price(answer: Answer) -> str:
    """Say what the law costs."""
    return f"The law {prose(call_laws(answer.price))}." if answer.is_tested else "It is not tested."


def list_needs(answer: Answer) -> Iterator[tuple]:
    """Return a row for each kind of controller."""
    for need in answer.needs:
        law = f"{link_law(need.law)} ({need.attribution})" if need.law != NOT_TESTED else need.law
        yield prose(need.controller), law, prose(call_laws(need.why)), prose(call_laws(need.price))


def link_law(name: str) -> str:
    """Return a law's name with a link to its page, from the front page."""
    return families.link(name, families.word(name)).replace('href="../', 'href="', 1)
