"""The answer: the front by brute force, and decisions on laws made up for them."""

import math

import numpy as np
import pytest
from support.user_law import spring_text

from bench.contenders.described_law import described
from bench.contenders.registry import contenders_of, find_contender
from bench.findings.selection.criteria import BY_NAME, CRITERIA, jump
from bench.findings.selection.front import front
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import NEEDS, Fact, Need, decide
from bench.findings.selection.tables import Tables

CHEAP, MIDDLE, DEAR = "quaternion-shortest", "mrp", "hybrid"
ANY = Fact("is a law", lambda found, law: True)


def beaten(point, points):
    return any(
        all(a <= b for a, b in zip(other, point, strict=True)) and tuple(other) != tuple(point) for other in points
    )


@pytest.mark.parametrize(("count", "columns"), [(1, 2), (40, 2), (40, 3), (60, 4)])
def test_front_is_what_brute_force_finds(count, columns):
    # few different numbers, so that ties and equal points occur
    points = np.random.default_rng(count + columns).integers(0, 6, size=(count, columns)).astype(float)
    assert list(front(points)) == [not beaten(point, points) for point in points]


def test_front_leaves_out_what_is_not_a_number_and_keeps_what_is_infinite():
    points = np.array([[1.0, np.inf], [2.0, 3.0], [np.nan, 0.0], [2.0, 4.0]])
    assert list(front(points)) == [True, True, False, False]


def made_up(**values):
    """Laws with these values of criteria: criterion -> law -> values."""
    contenders = {name: find_contender(name) for name in (CHEAP, MIDDLE, DEAR)}
    tables = Tables(None, None, {}, None, None, contenders)
    return Measured(tables, {one.name: {} for one in CRITERIA} | values)


def alone(cheap, middle, dear):
    return {name: np.array([value]) for name, value in ((CHEAP, cheap), (MIDDLE, middle), (DEAR, dear))}


@pytest.mark.parametrize(
    ("by", "values", "law", "alike", "second"),
    [
        ("peak", alone(3.0, 1.0, 2.0), MIDDLE, (), DEAR),
        ("peak", {CHEAP: np.array([3.0]), DEAR: np.array([2.0])}, DEAR, (), CHEAP),  # the other was not asked
        ("peak", alone(1.005, 1.0, 2.0), CHEAP, (MIDDLE,), DEAR),  # of equals the cheapest, the others beside it
        ("cost", alone(77.0, 76.9, 90.0), MIDDLE, (), CHEAP),  # of costs none are equal but equal ones
        ("held", alone(0.01, 0.03, math.inf), DEAR, (), MIDDLE),  # more is better
    ],
)
def test_need_names_the_best_its_equals_and_the_next(by, values, law, alike, second):
    decision = decide(Need("", "", (ANY,), by), made_up(**{by: values}))
    assert (decision.law, decision.alike, decision.next) == (law, alike, second)
    value = values[law][0]
    assert decision.number == (value, value, value)


def test_need_asks_its_facts_first():
    found = made_up(peak=alone(3.0, 1.0, 2.0), memory=alone(0.0, 4.0, 4.0))
    forgets = Fact("", lambda found, law: not found.number("memory", law))
    decision = decide(Need("", "", (forgets,), "peak"), found)
    assert (decision.law, decision.next, decision.asked) == (CHEAP, None, 1)


def test_need_that_no_law_meets_names_none():
    never = Fact("", lambda found, law: False)
    assert decide(Need("", "", (never,), "peak"), made_up(peak=alone(3.0, 1.0, 2.0))).law is None


def starts(offset, noise, seed):
    return 0.6 + offset + noise * np.random.default_rng(seed).standard_normal(50)


def test_difference_within_the_chance_of_the_starts_is_none():
    values = {CHEAP: starts(0.02, 0.3, 1), MIDDLE: starts(0.0, 0.3, 2), DEAR: starts(5.0, 0.3, 3)}
    decision = decide(Need("", "", (ANY,), "late"), made_up(late=values))
    assert {decision.law, *decision.alike} == {CHEAP, MIDDLE}
    assert decision.next == DEAR
    assert decision.number.low < decision.number.value < decision.number.high


def test_difference_at_every_start_is_one_however_starts_differ():
    hard = starts(0.0, 0.3, 1)
    values = {CHEAP: hard + 0.02, MIDDLE: hard, DEAR: hard + 5.0}
    assert decide(Need("", "", (ANY,), "late"), made_up(late=values)).law == MIDDLE


def test_law_that_settles_beats_one_that_does_not():
    values = {CHEAP: np.full(8, np.inf), MIDDLE: np.full(8, np.inf), DEAR: np.full(8, 3.0)}
    found = made_up(late=values)
    assert found.beats("late", DEAR, CHEAP)
    assert not found.beats("late", CHEAP, MIDDLE)


def test_every_need_ranks_by_a_criterion_and_every_criterion_says_what_it_means():
    assert {need.by for need in NEEDS} <= set(BY_NAME)
    assert len({one.name for one in CRITERIA}) == len(CRITERIA)
    assert all(one.meaning for one in CRITERIA)
    assert len({need.words for need in NEEDS}) == len(NEEDS)


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
