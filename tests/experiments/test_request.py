"""What a suite says to each experiment, and what a request is: words and numbers that JSON can hold."""

import dataclasses
import json

import pytest

from bench.base.errors import BadNumber, UnknownWord
from bench.experiments import plan
from bench.experiments.experiment import known_experiments
from bench.experiments.request import KINDS, Request, checked
from bench.experiments.slices import read_on_arms, read_slices
from bench.experiments.suites import LISTS, LONG, NOMINAL, ON_ARM, SHORT, SUITES, expand
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains
from bench.running.wire_format import described, plan_of


def keys_of(section):
    """The keys of a section, those of its own sections too; a number of starts may be of any set."""
    found = {}
    for name, value in section.items():
        is_section = isinstance(value, dict) and not name.startswith("sizes")
        found[name] = keys_of(value) if is_section else None
    return found


@pytest.mark.parametrize("suite", SUITES.values())
def test_suites_have_the_same_sections_with_the_same_keys_each_for_an_experiment(suite):
    """A key that is misspelt in one suite is another key."""
    assert keys_of(suite.sections) == keys_of(SUITES["quick"].sections)
    assert suite.sections.keys() <= known_experiments().keys()


def test_a_list_stands_for_its_words_and_all_for_everything():
    declared = {"words": ["LATER", "mine"], "starts": "all", "nested": {"sizes": {"clear": "all", "wrist": 3}}}
    expected = {
        "words": (*LISTS["LATER"], "mine"),
        "starts": None,
        "nested": {"sizes": {"clear": None, "wrist": 3}},
    }
    assert expand(declared) == expected


def test_slices_are_units_without_a_contender_on_uniform_and_on_directed_starts():
    some, every = read_slices((("ideal-rk4", 9, ("half-turn",)),)), read_slices((("native", 0),))
    places = [(one.engine, one.selector, one.total, one.horizon_s) for one in some]
    assert places == [("ideal-rk4", "uniform", 9, SHORT), ("ideal-rk4", "half-turn", 0, LONG)]
    assert [one.selector for one in every] == [*LISTS["DIRECTED"]]
    assert {(one.experiment, one.contender, one.variation) for one in (*some, *every)} == {("", "", NOMINAL)}
    on_arm = read_on_arms({"clear": 2, "wrist": None})
    assert [(one.selector, one.total, one.horizon_s) for one in on_arm] == [("clear", 2, ON_ARM), ("wrist", 0, ON_ARM)]


def test_request_without_its_laws_is_json_and_comes_back_as_it_was():
    request = Request("quick", gains=Gains(4.0, 2.0), seed=3, arms=("ur5e",), count=2)
    content = json.loads(json.dumps(dataclasses.asdict(request)))
    content |= {name: tuple(value) for name, value in content.items() if isinstance(value, list)}
    assert Request(**content | {"gains": Gains(*content["gains"])}) == request


def test_plan_on_the_wire_has_the_numbers_that_rows_depend_on():
    request = Request("quick", (find_contender("hybrid"),), Gains(4.0, 2.0), dt_s=2e-3, seed=3, axes=("delay",))
    made = plan.make(request)
    there = plan_of(json.loads(json.dumps(described(made, made.units))))
    assert there.units == made.units
    assert there.request.common() == made.request.common()
    assert there.request.gains == Gains(4.0, 2.0)


def test_each_word_is_once():
    twice = {kind: () for kind in KINDS} | {"arms": ("ur5e", "panda", "ur5e"), "experiments": ("arm", "arm")}
    once = checked(Request("quick", **twice))
    assert (once.arms, once.experiments) == (("ur5e", "panda"), ("arm",))


@pytest.mark.parametrize(
    ("options", "error"),
    [
        ({"suite": "quik"}, UnknownWord),
        ({"integrator": "rk5"}, UnknownWord),
        ({"arms": ("ur5",)}, UnknownWord),
        ({"seed": -1}, BadNumber),
        ({"gains": Gains(0.0, 1.0)}, BadNumber),
        ({"count": 0}, BadNumber),
        ({"horizon_s": 1e-4}, BadNumber),
    ],
)
def test_request_that_nothing_can_be_run_of_is_refused(options, error):
    with pytest.raises(error):
        checked(Request(**{"suite": "quick"} | options))


def test_own_gains_are_those_of_the_unit():
    laws = (find_contender("mrp"),)
    units = plan.make(Request("quick", laws, arms=("ur5e",), experiments=("arm",))).units
    gains = {Gains(unit.kp, unit.kv) for unit in units if unit.kp}
    assert Gains(25.0, 10.0) in gains
