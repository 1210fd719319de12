"""Contracts that every experiment keeps: it runs only where each named word narrows it."""

import pytest

from bench.base.errors import Incompatible
from bench.experiments import plan
from bench.experiments.choice import Choice
from bench.experiments.experiment import known_experiments
from bench.law.contenders.registry import find_contender

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


@pytest.mark.parametrize("kind", NAMED)
def test_named_word_leaves_only_experiments_that_take_it(kind):
    made = plan.make("quick", LAWS, Choice(**{kind: (NAMED[kind],)}))
    planned = {unit.experiment for unit in made.units}
    assert planned
    assert planned <= {one.name for one in known_experiments().values() if kind in one.takes}


def test_every_word_of_a_choice_is_tried_here():
    assert {*NAMED, "experiments"} == {*vars(Choice())}


@pytest.mark.parametrize("one", known_experiments().values(), ids=lambda one: one.name)
def test_word_that_a_named_experiment_does_not_take_is_refused(one):
    for kind in NAMED.keys() - {*one.takes}:
        with pytest.raises(Incompatible, match=f"'{NAMED[kind]}' cannot narrow the experiment '{one.name}'"):
            plan.make("quick", LAWS, Choice(**{kind: (NAMED[kind],)}, experiments=(one.name,)))
