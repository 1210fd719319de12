"""Which law, and for what a robot takes: fronts by brute force, ties, decisions on made-up and reference rows."""

import functools
import math

import numpy as np
import pandas as pd
import pytest
from support.advised import velocities
from support.user_law import spring_text

from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.tables.read import with_contender
from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.standing import MEASURABLE
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.criteria import BY_NAME, CRITERIA, jump
from bench.findings.selection.needs import GENERAL, Measured, Need, decide, dominates, front, measured
from bench.findings.selection.robots import (
    POSITION,
    ROBOTS,
    VELOCITY,
    decide_for,
    measure_velocities,
)
from bench.findings.selection.tables import Tables, ticks
from bench.findings.selection.words import together
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of, find_contender

CHEAP, MIDDLE, DEAR = "quaternion-shortest", "mrp", "hybrid"
"""The simplest first: the last has memory."""

FLOPS = {CHEAP: 60, MIDDLE: 70, DEAR: 50}


def made_up(**values):
    """Laws with these values of criteria: criterion -> law -> values."""
    contenders = {name: find_contender(name) for name in (CHEAP, MIDDLE, DEAR)}
    counted = {name: counts(flops) for name, flops in FLOPS.items()}
    tables = Tables(None, None, counted, None, None, {}, contenders)
    return Measured(tables, {one.name: {} for one in CRITERIA} | values)


def counts(flops):
    """A law's rows of costs.parquet, without a call."""
    rows = [("total", flops), ("goal", 0)]
    return pd.DataFrame(rows, columns=["stage", "flops"]).assign(branch="typical", sin=0, cos=0, atan2=0, acos=0)


def alone(cheap, middle, dear):
    return {name: np.array([value]) for name, value in ((CHEAP, cheap), (MIDDLE, middle), (DEAR, dear))}


def test_circle_of_laws_of_which_each_dominates_the_next_is_kept_whole():
    near, between, far = 1.0, 1.0075, 1.015
    found = made_up(time=alone(near, far, between), effort=alone(between, near, far), peak=alone(far, between, near))
    laws, by = [CHEAP, MIDDLE, DEAR], ("time", "effort", "peak")
    assert all(dominates(found, laws[i], laws[(i + 1) % 3], by) for i in range(3))
    assert front(found, laws, by) == laws


@pytest.mark.parametrize(
    ("by", "values", "law", "tied", "best"),
    [
        ("peak", alone(3.0, 1.0, 2.0), MIDDLE, (), (MIDDLE,)),
        ("peak", {CHEAP: np.array([3.0]), DEAR: np.array([2.0])}, DEAR, (), (DEAR,)),  # the other was not asked
        ("peak", alone(1.005, 1.0, 2.0), CHEAP, (MIDDLE,), (CHEAP, MIDDLE)),  # of equals the simplest
        ("peak", alone(3.0, 1.0, 1.0), MIDDLE, (DEAR,), (MIDDLE, DEAR)),  # no memory before fewer operations
        ("held", alone(0.01, 0.03, math.inf), DEAR, (), (DEAR,)),  # more is better
    ],
)
def test_situation_names_the_best_and_its_equals_and_none_that_does_not_meet_it(by, values, law, tied, best):
    found = decide(Need((), (by,)), made_up(**{by: values}))
    assert (found.law, found.tied, found.best) == (law, tied, best)
    assert decide(Need((lambda found, law: False,), (by,)), made_up(**{by: values})).law is None


@pytest.mark.parametrize(("times", "is_better"), [((1.0, 4.9), False), ((1.0, 5.1), True), ((1.0, math.nan), False)])
def test_time_a_tick_counts_from_what_is_measurable_on_a_whole_controller(times, is_better):
    found = made_up(tick=alone(*times, 10.0))
    assert MEASURABLE == 0.04
    assert dominates(found, CHEAP, MIDDLE, ("tick",)) is is_better
    assert not found.beats("tick", MIDDLE, CHEAP)


def test_share_of_a_law_is_its_time_over_the_median_whole_controller():
    usual = {"representation": "", "jacobian": "", "inverse": "", "arm": "", "engine": "", "ticks": 10}
    whole = usual | {"what": "controller", "regulator": "rotation-matrix", "jacobian": "geometric", "inverse": "solve"}
    rows = [
        usual | {"what": "law", "regulator": "mrp", "ratio": 1.0},
        usual | {"what": "law", "regulator": "gibbs", "ratio": 4.0, "ticks": 0},
        *(whole | {"arm": arm, "ratio": ratio} for arm, ratio in zip("abc", (40.0, 50.0, 90.0), strict=True)),
        whole | {"regulator": "mrp", "arm": "a", "ratio": 1000.0},
    ]
    assert ticks(Results(None, {"timings": pd.DataFrame(rows)})) == {"mrp": 2.0}
    assert ticks(Results(None, {"timings": pd.DataFrame(rows[:2])})) == {}


def test_every_robot_decides_by_criteria_and_every_criterion_says_what_it_means():
    assert {by for robot in ROBOTS.values() for by in robot.need.by} | set(GENERAL) <= set(BY_NAME)
    assert len({one.name for one in CRITERIA}) == len(CRITERIA)
    assert all(one.meaning for one in CRITERIA)


def test_names_that_are_many_are_counted():
    assert [together(list("abcde"[:count])) for count in range(1, 6)] == [
        "a",
        "a and b",
        "a, b and c",
        "a, b, c and d",
        "a, b, c and 2 more",
    ]


@pytest.mark.parametrize(
    ("law", "least", "most"),
    [
        ("rotation-matrix", 0.0, 1e-5),
        ("quaternion-shortest", 3.999, 4.001),
        ("rotation-vector", 2 * math.pi - 1e-3, 2 * math.pi + 1e-3),
        ("gibbs", 1e3, math.inf),
        ("hybrid", 0.0, 1e-5),
    ],
)
def test_jump_at_a_half_turn_is_twice_the_spring_there(law, least, most):
    assert least <= jump(find_contender(law)) <= most


def test_jump_of_a_law_on_coordinates_or_of_a_users_is_not_judged_by_half_turns(tmp_path):
    assert math.isnan(jump(find_contender("feedback-linearized/zyx-euler")))
    (tmp_path / "mine.py").write_text(spring_text("return (-x, -y, -z)"))
    assert math.isnan(jump(contenders_of(described(tmp_path / "mine.py"))[0]))


REFERENCE = RESULTS / "reference"
FASTEST = "mrp"


@functools.cache
def lagging():
    settings, laws = Settings("quick"), ("rotation-vector", FASTEST)
    units = [Unit("velocity", law, "free-body", count=24, horizon_s=2.5) for law in laws]
    units += [
        Unit("velocity", f"{law}@geometric+solve", "arm-regulation", "ur5e", count=2, horizon_s=2.5) for law in laws
    ]
    return with_contender(pd.concat([rows_of(settings, unit) for unit in units], ignore_index=True))


def test_position_is_judged_by_servos_that_lag():
    found = measure_velocities(Results(REFERENCE, {"velocity": lagging()}))
    rows = lagging()
    late = rows[(rows["lag_s"] > 0.0) & rows["contender"].astype(str).str.startswith(FASTEST)]
    assert len(found.values["late"][FASTEST]) == len(late)
    median = late["settling_time_s"].fillna(math.inf).median()
    assert found.number("late", FASTEST) == pytest.approx(median, abs=0.02)
    assert decide(POSITION.need, found).law == FASTEST


@pytest.mark.parametrize("robot", ROBOTS.values())
def test_robot_has_a_word_of_the_reference(robot):
    assert decide_for(robot, REFERENCE).law


@pytest.mark.parametrize(
    "criterion", ["unsettled", "lost", "detour", "time", "worst", "peak", "tick", "memory", "arms"]
)
def test_criterion_of_velocity_laws_is_what_their_rows_say(criterion):
    found, expected = measured(REFERENCE, measure_velocities), velocities().number(criterion)
    assert {law: found.number(criterion, law) for law in expected.index} == pytest.approx(dict(expected), nan_ok=True)


def test_law_that_is_dead_and_law_that_unwinds_are_not_asked():
    asked = velocities().decide(VELOCITY.need).asked
    assert not {"rotation-matrix", "quaternion-unwinding"} & set(asked)
    assert "rotation-vector" in asked


def test_run_that_commands_no_robot_by_velocities_is_no_evidence(tmp_path):
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        measure_velocities(Results(tmp_path))
    rows = Results(REFERENCE).table("velocity").iloc[:0]
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        measure_velocities(Results(REFERENCE, {"velocity": rows}))
