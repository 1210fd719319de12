"""Units as JSON, of which another process makes the same rows; and the order in which units run."""

import json

import pandas as pd
import pytest
from support.unit_kinds import plan_of_all_kinds

from bench.base.errors import BadResults
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.experiments.experiment import known_experiments, rows_of
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import find_contender
from bench.running import wire_format
from bench.running.run import in_running_order


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return plan_of_all_kinds(tmp_path_factory.mktemp("own"))


@pytest.fixture(scope="module")
def carried(made):
    """The plan as it is on the other side."""
    return wire_format.plan_of(json.loads(json.dumps(wire_format.described(made, made.units))), load_law)


def test_chunk_has_the_units_of_every_kind(made, carried):
    assert {unit.experiment for unit in made.units} == known_experiments().keys()
    assert carried.units == made.units


def test_other_process_makes_the_same_rows_of_a_chunk(made, carried):
    for unit in made.units:
        both = (rows_of(plan.settings, unit) for plan in (carried, made))
        pd.testing.assert_frame_equal(*both, check_exact=True)


def test_chunk_of_one_unit_carries_no_law_of_another(made):
    assert len(wire_format.described(made, made.units)["settings"]["own"]) == 1
    assert wire_format.described(made, made.of("contact"))["settings"]["own"] == []


def test_chunk_of_other_sources_is_refused(made):
    with pytest.raises(BadResults, match="install the same commit and lock on every machine"):
        wire_format.plan_of(wire_format.described(made, made.units) | {"sources": "0123456789abcdef"})


def test_first_unit_of_each_contender_runs_before_the_rest_of_the_one_before_it():
    laws = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]
    beside = Choice(experiments=("free-body", "contact", "robustness"))
    off_arms, on_arm = (planning.make("quick", laws, one, count=4) for one in (beside, Choice(arms=("ur5e",))))
    units = (*off_arms.units, *on_arm.of("arm"))
    each = {name: [unit for unit in units if unit.contender == name] for name in [unit.contender for unit in units]}
    assert len(each) > 4
    assert all(len(own) > 1 for own in each.values())
    (first, *rest), *others = each.values()
    expected = [first]
    for head, *tail in others:
        expected += [head, *rest]
        rest = tail
    assert in_running_order(units) == [*expected, *rest]
    compiling_none = on_arm.of("costs", "jacobians")
    assert in_running_order((*compiling_none, *units)) == [*expected, *rest, *compiling_none]
