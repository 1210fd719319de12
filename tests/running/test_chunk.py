"""Units as JSON: another process makes the same rows of it, and refuses those of other sources."""

import json

import pandas as pd
import pytest
from support.unit_kinds import plan_of_all_kinds

from bench.base.errors import BadResults
from bench.experiments.experiment import known_experiments, rows_of
from bench.law.contenders.law_file import load_law
from bench.running import wire_format


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
