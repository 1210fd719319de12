"""Contracts that every perturbation in tasks/conditions and every experiment keeps; new files are under them."""

import math

import numpy as np
import pytest
from support.each import each

import tasks
from bench.base.errors import Incompatible
from bench.base.provenance import ROOT
from bench.engines.plants import perturbed
from bench.experiments import plan
from bench.experiments.choice import Choice
from bench.experiments.experiment import known_experiments
from bench.law.contenders.registry import find_contender
from tasks.axis import Field
from tasks.condition import Condition, condition_at, declared_fields
from tasks.errors import BadValue

AXES = [tasks.axis(name) for name in tasks.axis_names()]

axis = each(AXES)


def test_it_is_named_as_its_file_says_what_it_is_and_levels_grow_the_nominal_one_among_them(axis):
    assert tasks.axis(axis.name) is axis
    assert axis.title
    assert axis.unit
    assert len(axis.levels) > 1
    assert np.all(np.diff(axis.levels) > 0)
    assert axis.nominal is None or axis.nominal in axis.levels


def test_at_its_nominal_level_nothing_is_wrong(axis):
    if axis.nominal is None:
        assert Condition() not in [condition_at(axis, level) for level in axis.levels]
    else:
        assert condition_at(axis, axis.nominal)._replace(feedforward=Condition().feedforward) == Condition()


def test_each_level_differs_from_the_others_in_condition_or_starts(axis):
    met = [(condition_at(axis, level), tuple(axis.starts(3, 0, level))) for level in axis.levels]
    assert len(set(met)) == len(met)


def test_conditions_are_of_this_world(axis):
    for level in axis.levels:
        met = condition_at(axis, level)
        x, y, z = sorted(met.inertia)
        assert x > 0.0
        assert x + y >= z * (1.0 - 1e-12)
        assert met.period_s > 0.0
        assert met.bound > 0.0
        assert min(met.delay_s, met.attitude_noise, met.rate_noise) >= 0.0
        assert min(met.worst_attitude_error, met.reference_amplitude) >= 0.0


def test_delays_are_whole_steps_of_the_plant(axis):
    for level in axis.levels:
        met = condition_at(axis, level)
        steps = met.delay_s / (met.period_s / perturbed.steps_of(met))
        assert steps == pytest.approx(round(steps), abs=1e-9)


@pytest.mark.parametrize("seed", [0, 7])
def test_starts_are_as_many_as_asked_for_and_differ(axis, seed):
    for level in axis.levels:
        starts = axis.starts(12, seed, level)
        assert len({one.id for one in starts}) == len({one.quat_wxyz for one in starts}) == 12
        assert axis.starts(5, seed, level) == starts[:5]
        for one in starts:
            assert math.hypot(*one.quat_wxyz) == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ([Field("bias", 0.0, "none")], "tasks/conditions/one.py: the field 'bias' does not say whether .* lasts; give"),
        ([Field("bias", 0.0, "none", lasts=True)] * 2, "'bias' is declared by two files"),
        ([Field("bias", (0.0, 0.0), "none", lasts=True)], "must be a number or three numbers"),
    ],
)
def test_field_that_no_verdict_could_be_given_of_is_refused(fields, reason):
    with pytest.raises(BadValue, match=reason):
        declared_fields({"one": AXES[0]._replace(fields=tuple(fields))})


def test_every_field_is_read_by_an_engine_or_the_experiment():
    files = [*(ROOT / "bench/engines").rglob("*.py"), ROOT / "bench/experiments/robustness.py"]
    texts = [path.read_text(encoding="utf-8") for path in files]
    assert [name for name in Condition._fields if not any(f".{name}" in text for text in texts)] == []


def test_axis_that_sets_an_undeclared_field_is_refused():
    with pytest.raises(BadValue, match="'delay' sets 'dela', a field that no file of tasks/conditions declares"):
        condition_at(tasks.axis("delay")._replace(sets=lambda level: {"dela": level}), 0.0)


NAMED = {
    "tasks": "free-body",
    "start_sets": "half-turn",
    "engines": "native",
    "arms": "ur5e",
    "jacobians": "geometric",
    "inverses": "solve",
    "variations": "mass-1.30",
    "controllers": "impedance-geometric",
    "regulators": "rotation-matrix",
    "representations": "zyx-euler",
    "axes": "delay",
}
LAWS = [find_contender("rotation-matrix"), find_contender("linearized-euler/zyx-euler")]


@pytest.mark.slow
@pytest.mark.parametrize("kind", NAMED)
def test_named_word_leaves_only_experiments_that_take_it(kind):
    made = plan.make("quick", LAWS, Choice(**{kind: (NAMED[kind],)}))
    planned = {unit.experiment for unit in made.units}
    assert planned
    assert planned <= {one.name for one in known_experiments().values() if kind in one.takes}


def test_every_word_of_a_choice_is_tried_here():
    assert {*NAMED, "experiments"} == {*vars(Choice())}


@pytest.mark.parametrize("one", known_experiments().values())
def test_word_that_a_named_experiment_does_not_take_is_refused(one):
    for kind in NAMED.keys() - {*one.takes}:
        with pytest.raises(Incompatible, match=f"'{NAMED[kind]}' cannot narrow the experiment '{one.name}'"):
            plan.make("quick", LAWS, Choice(**{kind: (NAMED[kind],)}, experiments=(one.name,)))
