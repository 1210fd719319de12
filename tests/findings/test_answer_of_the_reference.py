"""The advice that the committed run gives: one in each situation wherever it is read, and no winner of a tie."""

import functools

import pytest
from support import advised
from support.pages import assert_is_whole

from bench.experiments import suites
from bench.experiments.tables.read import with_contender
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read_arrow
from bench.findings import claims
from bench.findings.claims.standing import MEASURABLE
from bench.findings.claims.tables import Results
from bench.findings.on_arms import best
from bench.findings.selection import gains, robots
from bench.findings.selection.measured import measured
from bench.findings.selection.needs import (
    ARM,
    DEFAULT,
    EVERYWHERE,
    NEEDS,
    UNHELD,
    advice,
    advise,
    has_all,
)
from report.figures.answer import which_law
from report.figures.arms import arm_ranking, arm_rows
from report.figures.cards import regulators
from report.figures.kit import families
from report.figures.kit.page import run_in

FOLDER = RESULTS / "reference"
RUN = run_in(FOLDER)

DECIDED = {
    "accelerations": (advised.accelerations, advice, (DEFAULT, *NEEDS)),
    "velocities": (
        advised.velocities,
        functools.partial(robots.advise_for, robots.VELOCITIES),
        (robots.VELOCITY, *robots.VELOCITIES.needs),
    ),
}
"""Command -> the rule written again, the program's own advice, and the situations, the usual one first."""


@pytest.fixture(scope="module")
def found():
    return measured(FOLDER)


@functools.cache
def decided():
    return advice(FOLDER)


# ------------------------------------------------------------------------------------------- the advice


@pytest.mark.parametrize("command", DECIDED)
def test_every_situation_is_decided_as_by_the_rule_written_again(command):
    again, given, (usual, *situations) = DECIDED[command]
    advice = given(FOLDER)
    program = {one.need: one for one in (advice.default, *advice.exceptions, *advice.others)}
    assert set(program) == {usual, *situations}
    for need, (_, *decision) in program.items():
        assert again().decide(need) == tuple(decision), need.words
    decisive = [need for need in situations if again().is_decisive(need, advice.default.law)]
    assert [one.need for one in advice.exceptions] == decisive


def test_laws_that_are_advised_and_run_on_arms_are_in_the_suite():
    on_arms = {word.partition("@")[0] for word in (*suites.LAWS, *suites.BEST)}
    assert {decided().default.law, decided().of(ARM).law} <= on_arms


def test_no_law_without_memory_settles_everywhere_and_is_not_held(found):
    # Bhat and Bernstein 2000; Mayhew, Sanfelice and Teel 2011
    forgetful = [law for law in found.laws if not found.number("memory", law) and law in found.values["held"]]
    assert len(forgetful) > 5
    assert not [law for law in forgetful if has_all(found, law, (EVERYWHERE, UNHELD))]


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


# --------------------------------------------------------------------------------- wherever it is read


def test_front_page_lead_and_table_name_the_advised_law():
    law = decided().default.law
    word = families.word(law)
    for text in (which_law.front_page(RUN), which_law.lead(RUN)):
        assert text.startswith(word[0].upper() + word[1:])
    lines = which_law.decided(decided(), measured(FOLDER)).splitlines()[2:]
    for one, line in zip((decided().default, *decided().exceptions), lines, strict=True):
        cells = line.split(" | ")
        assert cells[0].removeprefix("| ") == one.need.words
        assert f"laws/{families.anchor(one.law)}.html" in cells[1]
        assert not one.tied or all(families.word(law) in line for law in one.tied[:2])


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


def test_open_question_has_the_advised_law_among_the_later_laws_that_were_judged():
    assert decided().default.law in claims.judge("C27", Results(FOLDER)).evidence.parts["answers"]


# ---------------------------------------------------------------------------------------------- the page


def test_page_is_whole():
    assert_is_whole(which_law, RUN)


# ------------------------------------------------------------------------------------------- our own law


def test_no_law_of_ours_is_advised_at_any_damping_ratio():
    for found in gains.committed():
        one = advise(found)
        own = gains.ours(found)
        assert own
        assert own not in {each.law for each in (one.default, *one.exceptions, *one.others)}
