"""The advice of the map and of the committed run: the rules written again, and the same law wherever it is read."""

import re

import pytest
from support import advised, map_rule
from support.pages import RUN

from bench.experiments import suites
from bench.experiments.tables.run import Run, with_contender
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read_arrow
from bench.findings import claims
from bench.findings.claims.standing import MEASURABLE
from bench.findings.on_arms import best
from bench.findings.selection.regions import (
    decide,
    decide_all,
    find_default,
    find_regions,
    list_facts,
)
from bench.findings.selection.robots import ARM, POSITION, VELOCITY, decide_for
from bench.findings.selection.run_rows import compare_run, is_unheld, settles_everywhere
from bench.findings.selection.unbeaten import find_bounds
from bench.findings.selection.words import describe_bounds
from report.figures import index
from report.figures.answer import which_law
from report.figures.arms import arm_rows, arms
from report.figures.cards import regulators
from report.figures.kit import families

FOLDER = RUN.folder


@pytest.mark.parametrize(
    ("robot", "again"),
    [(ARM, advised.arms), (VELOCITY, advised.velocities), (POSITION, advised.positions)],
)
def test_robot_is_advised_as_by_the_rule_written_again(robot, again):
    assert again().decide() == advised.unordered(decide_for(robot, FOLDER))


def test_run_of_the_free_body_gives_the_law_of_the_map():
    compared = compare_run(FOLDER)
    assert decide(compared.rows, pairs=compared.pairs).law == find_default()


def test_map_is_decided_as_by_the_rule_written_again():
    again = map_rule.map_verdicts()
    assert {at: (one.law, one.unbeaten, one.ours, one.faster) for at, one in decide_all().items()} == again
    assert [tuple(one) for one in find_regions()] == map_rule.widest()


def test_laws_that_are_advised_and_run_on_arms_are_in_the_suite():
    on_arms = {word.partition("@")[0] for word in (*suites.LAWS, *suites.LATER)}
    assert decide_for(ARM, FOLDER).law in on_arms


def test_no_law_without_memory_settles_everywhere_and_is_not_held():
    # Bhat and Bernstein 2000; Mayhew, Sanfelice and Teel 2011
    rows = compare_run(FOLDER).rows.dropna(subset="held")
    forgetful = rows[[fact.memory == 0 for fact in list_facts(rows)]]
    assert len(forgetful) > 5
    assert not (settles_everywhere(forgetful) & is_unheld(forgetful)).any()


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


def test_front_page_lead_and_table_name_the_advised_law_and_its_bounds():
    law, shown = find_default(), index.facts(RUN)
    assert families.word(law) in shown["answer"]
    assert describe_bounds(find_bounds(law)) in shown["condition"]
    assert f"Use **{families.word(law)}**" in which_law.lead()
    lines = str(which_law.facts(RUN)["regions"]).splitlines()[2:]
    for one, line in zip(find_regions(), lines, strict=False):  # the smallest regions have no line
        assert f"laws/{families.anchor(one.law)}.html" in line
        assert describe_bounds(find_bounds(one.law)) in line


@pytest.mark.parametrize("measure", ["settled", "range"])
def test_law_that_is_advised_for_an_arm_is_among_the_best_of_its_page(measure):
    uniform = arms.of_laws(arm_rows.episodes(RUN), "uniform")
    assert f"{decide_for(ARM, FOLDER).law}@geometric" in best(uniform, measure, "controller")


def test_cards_say_in_how_many_situations_a_law_is_advised():
    for one in find_regions():
        said = regulators.advised(one.law)
        assert f"The rule recommends this law in {regulators.say_share(one.advised)}." in said
        assert f"{100 * one.advised:.0f} %" in said or one.advised < 0.01
    assert "The rule does not recommend this law, because this law is ours" in regulators.advised("late-braking")
    assert regulators.advised("gibbs") == ""


def test_open_question_has_the_advised_law_among_the_later_laws_that_were_judged():
    answers = claims.judge("C27", Run(FOLDER)).evidence.instead
    assert re.search(rf"(: |; ){find_default()} \(", answers)
