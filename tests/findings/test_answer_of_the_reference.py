"""The advice that the committed run gives: one in each situation wherever it is read, and no winner of a tie."""

import functools
import re

import numpy as np
import pytest
from scipy.stats import bootstrap
from support.pages import assert_is_whole

from bench.contenders.registry import find_contender
from bench.experiments import suites
from bench.findings import claims
from bench.findings.claims.standing import MEASURABLE
from bench.findings.claims.tables import Results
from bench.findings.on_arms import best
from bench.findings.selection import gains, needs
from bench.findings.selection.criteria import BY_NAME
from bench.findings.selection.measured import measured, statistic
from bench.findings.selection.needs import (
    ARM,
    DEFAULT,
    EVERYWHERE,
    FORGETS,
    NEEDS,
    UNHELD,
    advice,
    advise,
    has_all,
)
from bench.findings.selection.rule import GENERAL, dominates
from bench.findings.selection.words import leaders
from bench.tables.read import with_contender
from bench.tables.schema import RESULTS
from bench.tables.store import read_arrow
from report.figures import index
from report.figures.answer import plane, which_law
from report.figures.arms import arm_ranking, arm_rows, arms
from report.figures.cards import regulators
from report.figures.comparison import comparison
from report.figures.kit import families, html
from report.figures.kit.page import run_in
from report.figures.robustness import saturation

FOLDER = RESULTS / "reference"
RUN = run_in(FOLDER)

BY_CRITERION = {
    comparison: {"fastest": "time", "surest": "worst", "sparest": "effort", "peak_fastest": "matched"},
    saturation: {"tight_law": "bounded"},
}
"""Page -> facts that name what is best by a criterion."""


@pytest.fixture(scope="module")
def found():
    return measured(FOLDER)


@functools.cache
def decided():
    return advice(FOLDER)


def changed(found, criterion, law, value):
    """The measured laws with one number of one law another."""
    own = found.values[criterion] | {law: np.array([value])}
    return found._replace(values=found.values | {criterion: own})


# ------------------------------------------------------------------------------------------- the advice


def test_laws_that_are_advised_and_run_on_arms_are_in_the_suite():
    on_arms = {word.partition("@")[0] for word in (*suites.LAWS, *suites.BEST)}
    assert {decided().default.law, decided().of(ARM).law} <= on_arms


def test_default_is_a_law_with_memory():
    assert find_contender(decided().default.law).regulator.memory is not None


@pytest.mark.parametrize(("criterion", "value"), [("held", 0.01), ("lost", 1.0), ("detour", 2.0), ("unsettled", 1.0)])
def test_default_is_another_law_when_this_one_loses_what_is_asked(found, criterion, value):
    law = decided().default.law
    other = advise(changed(found, criterion, law, value)).default.law
    assert other in decided().default.asked
    assert other != law


def test_others_that_have_what_the_default_has_are_worse_by_something_and_better_by_nothing(found):
    one = decided().default
    assert one.tied or all(dominates(found, one.law, other, GENERAL) for other in one.asked if other != one.law)


def test_no_law_without_memory_settles_everywhere_and_is_not_held(found):
    # Bhat and Bernstein 2000; Mayhew, Sanfelice and Teel 2011
    forgetful = [law for law in found.laws if not found.number("memory", law) and law in found.values["held"]]
    assert len(forgetful) > 5
    assert not [law for law in forgetful if has_all(found, law, (EVERYWHERE, UNHELD))]


def test_every_law_that_is_advised_has_what_the_situation_asks(found):
    for one in decided().every:
        assert one.law is not None, one.need.words
        assert all(has_all(found, law, one.need.facts) for law in (one.law, *one.tied, *one.best))


def test_situation_that_decides_nothing_is_one_in_which_the_default_is_not_beaten(found):
    assert {one.need.words for one in decided().every[1:]} == {need.words for need in NEEDS}
    law = decided().default.law
    for one in decided().others:
        assert decided().of(one.need).law == law
        assert law in one.best or not needs.matters(found, one, law)
    for one in decided().exceptions:
        is_beaten = any(found.beats(by, other, law) for by in one.need.by for other in one.best)
        assert is_beaten or one.need.is_apart or not has_all(found, law, one.need.facts), one.need.words


def test_single_best_is_better_by_scipys_paired_bootstrap_too(found):
    tried = 0
    for one in decided().every:
        for by in one.need.by if len(one.best) == 1 and len(one.need.by) == 1 else ():
            taken = statistic(BY_NAME[by])
            values = [found.values[by][law] for law in one.asked if found.beats(by, one.law, law)]
            for beside in values if len(found.values[by][one.law]) > 1 else ():
                assert beaten(taken, found.values[by][one.law], beside).high < 0.0, by
                tried += 1
    assert tried > 5


def beaten(taken, own, others):
    """95 % interval of the difference of two laws' numbers, by scipy."""

    def difference(one, other, axis):
        return taken(one, axis=axis) - taken(other, axis=axis)

    kind = {"paired": True, "method": "percentile", "n_resamples": 999, "rng": np.random.default_rng(0)}
    return bootstrap((own, others), difference, **kind).confidence_interval


def test_time_of_laws_alone_is_what_tells_whole_controllers_apart():
    for path in (RESULTS / "timings").glob("*.parquet"):
        frame = with_contender(read_arrow(path, "timings").to_pandas())
        alone = frame[frame["what"] == "law"].set_index("contender")["ns_per_tick"]
        loops = frame[(frame["what"] == "engine") & (frame["engine"] == "native") & (frame["jacobian"] == "geometric")]
        loops = loops[loops["inverse"] == loops["arm"].map(lambda arm: "pseudo-inverse" if arm == "panda" else "solve")]
        for _, own in loops.groupby("arm", observed=True):
            whole = own.assign(law=own["contender"].astype(str).str.split("@").str[0]).set_index("law")["ns_per_tick"]
            difference = (whole - whole["rotation-matrix"]) - (alone[whole.index] - alone["rotation-matrix"])
            assert len(whole) > 3
            assert (difference.abs() <= MEASURABLE * whole).all(), difference


def test_no_advice_depends_on_the_bound_of_time_that_stood_before(monkeypatch):
    """3 % of a tick, when the rule was fixed."""
    assert BY_NAME["tick"].least > 3.0
    monkeypatch.setitem(BY_NAME, "tick", BY_NAME["tick"]._replace(least=3.0))
    assert advise(measured(FOLDER)) == decided()


# --------------------------------------------------------------------------------- wherever it is read


def test_front_page_lead_and_table_name_the_advised_law():
    law = decided().default.law
    word = families.word(law)
    for text in (which_law.front_page(RUN), which_law.lead(RUN), index.facts(RUN)["which_law"]):
        assert text.startswith(word[0].upper() + word[1:])
    lines = which_law.decided(decided(), measured(FOLDER)).splitlines()[2:]
    for one, line in zip((decided().default, *decided().exceptions), lines, strict=True):
        cells = line.split(" | ")
        assert cells[0].removeprefix("| ") == one.need.words
        assert f"laws/{families.anchor(one.law)}.html" in cells[1]
        assert not one.tied or all(families.word(law) in line for law in one.tied[:2])


def test_page_on_arms_names_the_law_that_is_advised_there():
    assert arms.facts(RUN)["advised"] == families.word(decided().of(ARM).law)


@pytest.mark.parametrize("measure", ["settled", "range"])
def test_law_that_is_advised_for_an_arm_is_among_the_best_of_its_page(measure):
    uniform = arm_ranking.of_laws(arm_rows.episodes(RUN), "uniform")
    assert f"{decided().of(ARM).law}@geometric" in best(uniform, measure, "controller")


def test_cards_name_each_situation_once_and_of_ties_all_laws(found):
    said = {law: regulators.advised(law, RUN) for law in found.laws}
    for one in (decided().default, *decided().exceptions):
        holders = [law for law, text in said.items() if one.need.words in text.partition("No worse")[0]]
        assert holders == [one.law]
        assert {law for law, text in said.items() if one.need.words in text.partition("No worse")[2]} == set(one.tied)


@pytest.mark.parametrize("page", BY_CRITERION, ids=lambda page: page.__name__)
def test_page_calls_best_what_the_rule_does(found, page):
    facts = page.facts(RUN)
    for key, criterion in BY_CRITERION[page].items():
        assert facts[key] == leaders(found, criterion, families.word)
        if "(a tie)" in facts[key]:
            assert "," in facts[key] or " and " in facts[key]


def test_open_question_has_the_advised_law_among_the_later_laws_that_were_judged():
    assert decided().default.law in claims.judge("C27", Results(FOLDER)).evidence.parts["answers"]


# ---------------------------------------------------------------------------------------------- the page


def test_plane_marks_what_settles_everywhere(found):
    assert plane.coverage(found, decided().default.law) == 2
    assert plane.coverage(found, decided().of(FORGETS).law) == 1
    assert plane.coverage(found, "rotation-matrix") == 0


def test_plane_has_time_across_where_all_are_timed_and_operations_elsewhere(found):
    costs, label = plane.across(found._replace(values=found.values | {"tick": {}}))
    assert "operations" in label
    timed = {law: np.array([1.0]) for law in costs}
    shares, label = plane.across(found._replace(values=found.values | {"tick": timed}))
    assert ("time" in label, set(shares.values())) == (True, {1.0})


def test_page_names_every_law_and_every_situation(found):
    laws, words = which_law.every_law(found), which_law.decided(decided(), found) + which_law.facts(RUN)["same"]
    named = re.sub("<[^>]*>", "", laws)
    assert all(html.foreign(families.word(law)) in named for law in found.laws)
    assert all(need.words in words for need in (DEFAULT, *NEEDS))


def test_page_is_whole():
    assert_is_whole(which_law, RUN)


# ------------------------------------------------------------------------------------------- our own law


def test_no_law_of_ours_is_advised_at_any_damping_ratio():
    for found in gains.committed():
        one = advise(found)
        own = gains.ours(found)
        assert own
        assert own not in {each.law for each in (one.default, *one.exceptions, *one.others)}


def test_comparison_with_ours_changes_its_word_when_a_number_does(found):
    own, law = gains.ours(found), decided().default.law
    assert "peak" in gains.compare(found, own, law).better
    assert "peak" in gains.compare(changed(found, "peak", own, 1e4), own, law).worse
