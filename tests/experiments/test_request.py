"""Suites have the same sections; a request is words and numbers, which JSON and another process can hold."""

import dataclasses
import json

import pytest

from bench.experiments import plan
from bench.experiments.experiment import known_experiments
from bench.experiments.request import Request
from bench.experiments.suites import SUITES
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains
from bench.running.wire_format import described, plan_of


def keys_of(section):
    """The keys of a section, and those of its own sections, but for numbers of starts by their sets."""
    is_section = isinstance(section, dict)
    return {name: keys_of(part) for name, part in section.items() if "sizes" not in name} if is_section else None


@pytest.mark.parametrize("suite", SUITES.values())
def test_suites_have_the_same_sections_with_the_same_keys_each_for_an_experiment(suite):
    """A key that is misspelt in one suite is another key."""
    assert keys_of(suite.sections) == keys_of(SUITES["quick"].sections)
    assert suite.sections.keys() <= known_experiments().keys()


def test_request_without_its_laws_is_json_and_comes_back_as_it_was():
    request = Request("quick", gains=Gains(4.0, 2.0), seed=3, arms=("ur5e",), count=2)
    content = json.loads(json.dumps(dataclasses.asdict(request)))
    content |= {name: tuple(value) for name, value in content.items() if isinstance(value, list)}
    assert Request(**content | {"gains": Gains(*content["gains"])}) == request


def test_plan_on_the_wire_has_the_numbers_that_rows_depend_on():
    request = Request("quick", (find_contender("hybrid"),), Gains(4.0, 2.0), dt_s=2e-3, seed=3, axes=("delay",))
    made = plan.make(request)
    there = plan_of(json.loads(json.dumps(described(made, made.units))))
    assert (there.units, there.request.common()) == (made.units, made.request.common())
