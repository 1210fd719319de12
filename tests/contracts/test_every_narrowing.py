"""Every option that narrows a plan leaves only the experiments that say they are narrowed by it."""

import pytest

from bench.contenders.registry import all_contenders
from bench.experiments.choice import Choice
from bench.experiments.experiment import known_experiments
from bench.experiments.plan import make

WORDS = {
    "tasks": "free-body",
    "start_sets": "uniform",
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


def test_every_option_has_a_word_here():
    assert {*WORDS, "experiments"} == set(vars(Choice()))


@pytest.mark.parametrize("option", WORDS)
def test_option_leaves_only_what_it_narrows(option):
    laws = [one for one in all_contenders(()) if one.regulator.name == "rotation-matrix" or option != "regulators"]
    units = make("quick", laws, Choice(**{option: (WORDS[option],)}), count=2).units
    assert all(option in known_experiments()[unit.experiment].narrowed_by for unit in units)
    named = {"tasks": "task", "arms": "arm", "engines": "engine", "start_sets": "selector", "axes": "selector"}
    field = named.get(option, "")
    met = [unit for unit in units if unit.experiment in ("free-body", "arm", "contact", "robustness")]
    assert met
    assert all(getattr(unit, field) == WORDS[option] for unit in met if field and getattr(unit, field))


@pytest.mark.parametrize("name", [name for name, one in known_experiments().items() if one.in_suites])
def test_named_experiment_runs_and_no_other(name):
    units = make("quick", all_contenders(()), Choice(experiments=(name,)), count=2).units
    assert {unit.experiment for unit in units} == {name}
