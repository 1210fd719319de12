"""The answer that the committed run gives: its verdicts, and that suites run on arms what it finds best."""

import math

import numpy as np
import pytest
from support.pages import assert_is_whole

from bench.contenders.registry import find_contender
from bench.experiments import suites
from bench.findings import claims
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import Word
from bench.findings.selection.best import best
from bench.findings.selection.measured import measured
from bench.findings.selection.needs import ANSWER, EVERYWHERE, NEEDS, UNHELD, decide, decisions, has_all
from bench.tables.schema import RESULTS
from report.figures.answer import plane, which_law
from report.figures.kit import families, html
from report.figures.kit.page import run_in

FOLDER = RESULTS / "reference"
LAW = "hybrid"


@pytest.fixture(scope="module")
def found():
    return measured(FOLDER)


@pytest.fixture(scope="module")
def decided():
    return {one.need.words: one for one in decisions(FOLDER)}


def changed(found, criterion, law, value):
    """The measured laws with one number of one law another."""
    own = found.values[criterion] | {law: np.array([value])}
    return found._replace(values=found.values | {criterion: own})


def test_suites_run_on_arms_the_six_that_are_best(found):
    assert tuple(f"{law}@geometric+standard" for law in best(found)) == suites.BEST


def test_answer_is_a_law_with_memory(found):
    answer = decide(ANSWER, found)
    assert answer.law == LAW
    assert find_contender(answer.law).regulator.memory is not None


@pytest.mark.parametrize(("criterion", "value"), [("held", 0.01), ("lost", 1.0), ("detour", 2.0), ("unsettled", 1.0)])
def test_answer_is_another_law_when_this_one_loses_what_is_asked(found, criterion, value):
    other = decide(ANSWER, changed(found, criterion, LAW, value)).law
    assert other == decide(ANSWER, found).next
    assert other != LAW


def test_no_law_without_memory_settles_everywhere_and_is_not_held(found):
    # Bhat and Bernstein 2000; Mayhew, Sanfelice and Teel 2011
    forgetful = [law for law in found.laws if not found.number("memory", law) and law in found.values["held"]]
    assert len(forgetful) > 5
    assert not [law for law in forgetful if has_all(found, law, (EVERYWHERE, UNHELD))]


def test_law_that_never_jumps_loses_half_turns(found):
    law = next(decide(need, found).law for need in NEEDS if need.words == "a command that never jumps")
    assert found.number("lost", law) > 0
    assert math.isclose(found.number("jump", law), 0.0, abs_tol=1e-5)


def test_every_need_leads_to_a_law_that_has_what_it_asks(found, decided):
    for need in NEEDS:
        one = decided[need.words]
        assert one.law is not None, need.words
        assert all(has_all(found, law, need.facts) for law in (one.law, *one.alike))
        assert one.next is None or not found.beats(need.by, one.next, one.law)


def test_cheapest_law_of_all_is_the_papers(decided):
    assert decided["the fewest operations, where half turns never occur"].law == "rotation-matrix"


def test_open_question_is_answered():
    verdict = claims.judge("C27", Results(FOLDER))
    assert verdict.word == Word.FAILS
    assert verdict.evidence.parts["answers"].startswith(LAW)
    assert verdict.evidence.parts["nearly"].startswith("late-braking")


def test_papers_verdict_has_later_laws_beside_it():
    assert f"{LAW} 100.00%" in str(claims.judge("C17", Results(FOLDER)).evidence)


def test_three_fronts_are_nested_by_what_they_ask_and_each_gets_dearer_and_faster(found):
    for least, members in enumerate(plane.fronts(found)):
        assert members
        assert all(plane.coverage(found, law) >= least for law in members)
        times = [found.number("time", law) for law in members]
        assert times == sorted(times, reverse=True)


def test_page_names_every_law_and_every_need(found, decided):
    every, needs = which_law.every_law(found), which_law.decided(decisions(FOLDER))
    assert all(f">{html.foreign(families.present([law])[0].laws[law])}<" in every for law in found.laws)
    assert all(words in needs for words in decided)


def test_cheapest_at_the_usual_price_is_the_answer(found):
    assert which_law.cheapest(found, which_law.CALL_PRICE) == families.word(LAW)


def test_page_is_whole():
    assert_is_whole(which_law, run_in(FOLDER))


def test_front_page_names_the_answer():
    assert families.word(LAW) in which_law.front_page(run_in(FOLDER))
