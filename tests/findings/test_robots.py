"""Which law for what a robot takes: on rows made here and of the reference, and where a run has none.

The rule itself is compared in test_answer_of_the_reference.
"""

import functools
import math

import pandas as pd
import pytest
from support.advised import velocities

from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.tables.read import with_contender
from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection import gains
from bench.findings.selection.measured import dominates, measured
from bench.findings.selection.needs import advice, decide, has_all
from bench.findings.selection.robots import (
    POSITION,
    ROBOTS,
    UNCANCELLED,
    VELOCITY,
    measure_uncancelled,
    measure_velocities,
    word_of,
)
from bench.law.contenders.registry import contenders

REFERENCE = RESULTS / "reference"
FASTEST = "mrp"


@functools.cache
def shipped():
    one = next(
        one for one in contenders("shipped").values() if one.level == "torque" and not one.shipped.shapes_inertia
    )
    return rows_of(Settings("quick"), Unit("shipped", selector=one.name, count=1, total=1, horizon_s=20.0))


@functools.cache
def lagging():
    settings, laws = Settings("quick"), ("rotation-vector", FASTEST)
    units = [Unit("velocity", law, "free-body", count=24, horizon_s=2.5) for law in laws]
    units += [
        Unit("velocity", f"{law}@geometric+solve", "arm-regulation", "ur5e", count=2, horizon_s=2.5) for law in laws
    ]
    return with_contender(pd.concat([rows_of(settings, unit) for unit in units], ignore_index=True))


def test_uncancelled_law_has_the_facts_and_nothing_dominates_it():
    found = measure_uncancelled(Results(REFERENCE, {"shipped": shipped()}))
    one = decide(UNCANCELLED, found)
    assert set(one.asked) == set(shipped()["law"].astype(str)) - {"", gains.ours(found)}
    assert has_all(found, one.law, UNCANCELLED.facts)
    assert not any(dominates(found, law, one.law, ("time", "worst", "tick")) for law in one.asked)


def test_uncancelled_law_that_rests_or_goes_the_long_way_is_not_asked():
    rows = shipped().copy()
    rows.loc[rows["law"] == FASTEST, "dead"] = 1
    rows.loc[rows["law"] == "rotation-vector", "away"] = 1
    asked = decide(UNCANCELLED, measure_uncancelled(Results(REFERENCE, {"shipped": rows}))).asked
    assert asked
    assert not {FASTEST, "rotation-vector"} & set(asked)


def test_uncancelled_choice_without_rows_is_no_evidence():
    rows = shipped()
    with pytest.raises(NoEvidence, match="no law was run"):
        measure_uncancelled(Results(REFERENCE, {"shipped": rows[rows["law"] == ""]}))


def test_position_is_judged_by_servos_that_lag():
    found = measure_velocities(Results(REFERENCE, {"velocity": lagging()}))
    rows = lagging()
    late = rows[(rows["lag_s"] > 0.0) & rows["contender"].astype(str).str.startswith(FASTEST)]
    assert len(found.values["late"][FASTEST]) == len(late)
    median = late["settling_time_s"].fillna(math.inf).median()
    assert found.number("late", FASTEST) == pytest.approx(median, abs=0.02)
    assert decide(POSITION, found).law == FASTEST


def test_every_robot_has_a_word_of_the_reference():
    words = {robot.takes: word_of(robot, REFERENCE) for robot in ROBOTS}
    assert all(one is not None and one.law for one in words.values())
    assert words["torques, and a model cancels the inertia"].law == advice(REFERENCE).default.law


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.page)
def test_robot_names_a_page_of_the_book(robot):
    assert (RESULTS.parent / "report" / "pages" / f"{robot.page}.md").is_file()


@pytest.mark.parametrize(
    "criterion", ["unsettled", "lost", "detour", "time", "worst", "peak", "tick", "memory", "arms"]
)
def test_criterion_of_velocity_laws_is_what_their_rows_say(criterion):
    found, expected = measured(REFERENCE, measure_velocities), velocities().number(criterion)
    assert {law: found.number(criterion, law) for law in expected.index} == pytest.approx(dict(expected), nan_ok=True)


def test_law_that_is_dead_and_law_that_unwinds_are_not_asked():
    asked = velocities().decide(VELOCITY).asked
    assert not {"rotation-matrix", "quaternion-unwinding"} & set(asked)
    assert "rotation-vector" in asked


def test_run_that_commands_no_robot_by_velocities_is_no_evidence(tmp_path):
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        measure_velocities(Results(tmp_path))
    rows = Results(REFERENCE).table("velocity").iloc[:0]
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        measure_velocities(Results(REFERENCE, {"velocity": rows}))
