"""Units as JSON: another process makes the same rows of it, and refuses those of other sources."""

import dataclasses
import json

import pandas as pd
import pytest

from bench import chunk, plan
from bench.choice import Choice
from bench.discovery import find_contender, load_law
from bench.errors import BadResults
from bench.work import rows

OWN = """
from bench.contender import Regulator
from bench.scalar import kernel


@kernel
def law(R, omega, goal, gains):
    return (-gains.kv * omega[0], -gains.kv * omega[1], -gains.kv * omega[2])


REGULATOR = Regulator("mine", "Mine", "none", "u", law)
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A plan with a unit of each kind, on the free body, an arm, in contact and in trouble, and with a user's law."""
    path = tmp_path_factory.mktemp("own") / "mine.py"
    path.write_text(OWN)
    laws = [find_contender("rotation-matrix"), find_contender("mine", (load_law(path),))]
    short = {"count": 2, "horizon_s": 0.05}
    alone = plan.make("quick", laws, Choice(start_sets=("paper",), engines=("ideal-rk4",)), **short)
    choices = (
        Choice(("arm-regulation",), ("clear",), ("native",), ("ur5e",), ("geometric",), ("solve",)),
        Choice(("wrench-probe",), arms=("ur5e",), controllers=("hybrid-base+inverse",)),
        Choice(axes=("delay",)),
    )
    others = [plan.make("quick", laws if choice.controllers == () else [], choice, **short) for choice in choices]
    contenders = dict.fromkeys(one for each in (alone, *others) for one in each.contenders)
    return dataclasses.replace(
        alone,
        units=(*alone.units, *others[0].units),
        contacts=others[1].contacts[:1],
        troubles=others[2].troubles,
        contenders=tuple(contenders),
    )


@pytest.fixture(scope="module")
def carried(made):
    """The plan as it is on the other side."""
    return chunk.plan_of(json.loads(json.dumps(chunk.described(made, made.work))))


def test_chunk_has_the_units_of_every_kind(made, carried):
    assert {unit.table for unit in made.work} == {"episodes", "compliance", "robustness"}
    assert carried.work == made.work


def test_other_process_makes_the_same_rows_of_a_chunk(made, carried):
    for unit in made.work:
        pd.testing.assert_frame_equal(rows(carried, unit), rows(made, unit), check_exact=True)


def test_chunk_of_one_unit_carries_no_law_of_another(made):
    assert len(chunk.described(made, made.work)["laws"]) == 1
    assert chunk.described(made, made.contacts)["laws"] == []


def test_chunk_of_other_sources_is_refused(made):
    with pytest.raises(BadResults, match="install the same commit and lock on every machine"):
        chunk.plan_of(chunk.described(made, made.units) | {"sources": "0123456789abcdef"})
