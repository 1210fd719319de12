"""The part of a plan that is under perturbations, and its rows."""

import numpy as np
import pandas as pd
import pytest

import tasks
from bench.base.errors import Incompatible, UnknownWord
from bench.cli.details import robustness as details
from bench.experiments import plan, robustness
from bench.experiments.choice import EVERYTHING, Choice
from bench.experiments.experiment import Asked
from bench.experiments.suites import SUITES
from bench.experiments.tables.read import with_contender
from bench.experiments.tables.schema import table_of
from bench.experiments.tables.store import read
from bench.law.contenders.registry import all_contenders, find_contender
from bench.running import run as running

LAWS = [one for one in all_contenders() if not one.regulator.costing_only]
TWO = [find_contender("rotation-matrix"), find_contender("hybrid")]


def units(choice, laws=TWO, suite="quick"):
    return robustness.units(Asked(SUITES[suite], tuple(laws), choice))


def made(choice, laws=TWO, **words):
    return plan.make("quick", laws, choice, **words)


@pytest.mark.parametrize("suite", SUITES)
def test_every_suite_perturbs_every_law_on_r_along_every_axis(suite):
    found = units(EVERYTHING, LAWS, suite)
    met = {(unit.contender, unit.selector) for unit in found}
    on_matrix = [one.name for one in LAWS if one.representation is None and not one.regulator.in_engine]
    assert met >= {(name, axis) for name in on_matrix for axis in tasks.axis_names()}
    assert len(met) == len(found)
    for unit in found:
        assert unit.episodes == unit.count * len(tasks.axis(unit.selector).levels)


def test_a_named_axis_is_all_that_runs():
    found = made(Choice(axes=("delay",)), count=3)
    assert {(unit.experiment, unit.selector) for unit in found.units} == {("robustness", "delay")}
    assert found.episodes("robustness") == found.episodes() == 2 * 3 * len(tasks.axis("delay").levels)


def test_words_that_an_axis_does_not_take_are_refused():
    with pytest.raises(Incompatible, match="takes both arms such as 'ur5e' and axes such as 'delay'"):
        made(Choice(axes=("delay",), arms=("ur5e",)))
    with pytest.raises(UnknownWord, match="did you mean 'delay'"):
        made(Choice(axes=("dely",)))
    with pytest.raises(Incompatible, match="laws of the free body"):
        made(Choice(axes=("delay",)), laws=[find_contender("in-engine")])


@pytest.fixture(scope="module")
def rows(tmp_path_factory) -> pd.DataFrame:
    out = tmp_path_factory.mktemp("perturbation")
    laws = [find_contender(word) for word in ("rotation-matrix", "hybrid", "gibbs")]
    running.run(
        made(Choice(axes=("delay", "equal-peak", "half-turn-noise"), experiments=("robustness",)), laws, count=3), out
    )
    return with_contender(read(out, "robustness"))


def test_there_is_a_row_for_each_law_level_and_start(rows):
    assert not rows.duplicated(list(table_of("robustness").key)).any()
    counts = rows.groupby(["contender", "axis", "level"], observed=True).size()
    assert (counts == 3).all()
    for axis in ("delay", "half-turn-noise"):
        assert sorted(rows.loc[rows["axis"] == axis, "level"].unique()) == list(tasks.axis(axis).levels)


def test_a_law_without_a_greatest_command_has_no_rows_at_equal_peak(rows):
    equal = rows[rows["axis"] == "equal-peak"]
    assert set(equal["contender"]) == {"rotation-matrix", "hybrid"}
    assert (equal["peak_u"] <= equal["level"] * (1.0 + 1e-6)).all()
    np.testing.assert_allclose(equal["kv"], 2.0 * np.sqrt(equal["kp"]))


def test_noise_at_the_half_turn_holds_the_law_that_rests_there_and_not_the_one_with_memory(rows):
    small = rows[(rows["axis"] == "half-turn-noise") & (rows["level"] == 0.01)]
    settled = (small["outcome"] == "settled").groupby(small["contender"], observed=True).mean()
    assert settled["hybrid"] == 1.0
    assert settled["rotation-matrix"] == 0.0


def test_table_says_up_to_which_level_a_law_withstands(rows):
    lines = details.summary(rows).set_index("law")
    assert lines.loc["rotation-matrix", "half-turn-noise"] == "none"
    assert float(lines.loc["hybrid", "half-turn-noise"]) < float(lines.loc["hybrid", "half-turn-noise, theory"])
    assert lines.loc["hybrid", "delay"] == f"{max(tasks.axis('delay').levels):g}+"  # the end of the grid
