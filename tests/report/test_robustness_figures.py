"""The pages on robustness, from a small run."""

import math
import re

import pytest

from bench.cli.details import robustness as details
from bench.experiments import plan
from bench.experiments.request import Request
from bench.experiments.tables.run import VARIABLE, run_in, with_contender
from bench.findings import perturbed, why
from bench.findings.perturbed import Direction
from bench.findings.theory import thresholds
from bench.law.contenders.registry import find_contender
from bench.running import run
from report.figures.cards import regulators
from report.figures.robustness import half_turn_noise, robustness

KP, KV = 100.0, 20.0
LAWS = ("rotation-vector", "paielli-bach", "hybrid", "quaternion-shortest", "quaternion-unwinding")
STARTS = 2


@pytest.mark.parametrize("law", ["hybrid", "late-braking"])
def test_cards_of_laws_with_memory_say_how_far_they_keep_to_their_way(law):
    _, fails = regulators.text_of(half_turn_noise.regulator_of(law))
    assert f"{math.degrees(thresholds.keeps(law)):.0f}°" in fails


@pytest.fixture(scope="module", autouse=True)
def small_run(tmp_path_factory):
    """Results with two starts a level of five laws; the pages read those of this module's folder."""
    laws = tuple(find_contender(law) for law in LAWS)
    made = plan.make(Request("quick", laws, count=STARTS, axes=robustness.AXES))
    folder = tmp_path_factory.mktemp("robustness") / "run"
    run.run(made, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, str(folder))
        yield run_in(folder)


def test_theory_says_which_laws_the_worst_noise_holds_at_the_half_turn(small_run):
    found = half_turn_noise.facts(small_run)
    assert re.fullmatch(r"all [1-9]\d*", found["agreement"])


def test_threshold_is_the_level_before_the_first_that_costs_a_law_its_starts(small_run):
    each, direction = robustness.found(small_run), Direction("half-turn-noise")
    assert (
        each["quaternion-shortest"][direction].held,
        each["quaternion-shortest"][direction].broken,
    ) == (0.0, 0.001)
    assert (each["hybrid"][direction].held, each["hybrid"][direction].broken) == (0.3, 1.0)
    assert math.isnan(each["paielli-bach"][direction].held)


def test_judge_and_show_have_one_threshold(small_run):
    rows_of_run = small_run.rows("robustness")
    lines = details.summary(rows_of_run).set_index("law")
    for law, own in perturbed.thresholds(with_contender(perturbed.by_level(rows_of_run))).items():
        text = why.perturbed(rows_of_run[rows_of_run["contender"] == law])[0].text
        for direction, one in own.items():
            assert lines.loc[law, direction.name] == str(one)
            assert f"{direction.name} {'none' if math.isnan(one.held) else f'{one.held:g}'}" in text


def test_moving_goals_break_every_law_where_theory_near_the_goal_says(small_run):
    for axis in ("moving-goal-rate", "moving-goal-untold"):
        limit = thresholds.near_goal(axis, True, KP, KV)
        for own in robustness.found(small_run).values():
            assert own[Direction(axis)].held < limit < own[Direction(axis)].broken
