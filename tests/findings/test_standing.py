"""How two laws stand in cost, and which controllers of arms are best: on tables typed by hand."""

import math

import pandas as pd
import pytest

from bench.experiments.tables.statistics import Estimate
from bench.findings.claims.standing import (
    MEASURABLE,
    ORDERED,
    REVERSED,
    UNDECIDED,
    Ledger,
    Operations,
    by_columns,
    price_of_a_call,
    times_of,
)
from bench.findings.on_arms import best, differs_significantly, passed

FLOP, CALL = 0.02, 1.2
COUNTS = {"a": (10, 0), "b": (40, 0), "c": (30, 3), "d": (60, 6), "e": (70, 1), "f": (90, 2)}


def near(value, half_width=0.05):
    return Estimate(value, value - half_width, value + half_width)


def ledger(times, cheap, dear, price=math.nan):
    return Ledger(times, ({"x": Operations(*cheap), "y": Operations(*dear)},), price).stand("x", "y")


@pytest.mark.parametrize(
    ("cheap", "dear", "sign"),
    [
        ((10, 1), (10, 2), ORDERED),
        ((10, 1), (9, 1), REVERSED),
        ((10, 1), (9, 2), UNDECIDED),
        ((10, 1), (10, 1), UNDECIDED),
    ],
)
def test_columns_order_two_laws_where_none_contradicts(cheap, dear, sign):
    assert by_columns(Operations(*cheap), Operations(*dear)) == sign


@pytest.mark.parametrize(
    ("times", "sign"),
    [
        ([{"x": near(1.0), "y": near(1.2)}], ORDERED),
        ([{"x": near(1.2), "y": near(1.0)}], REVERSED),
        ([{"x": near(1.0), "y": near(1.05)}], UNDECIDED),
        ([{"x": near(1.0)}], UNDECIDED),
        ([{"x": near(1.0), "y": near(1.2)}, {"x": near(1.0), "y": near(1.01)}], ORDERED),  # one machine does not tell
        ([{"x": near(1.0), "y": near(1.2)}, {"x": near(1.2), "y": near(1.0)}], UNDECIDED),
    ],
)
def test_time_decides_only_where_intervals_part_on_every_machine_that_tells(times, sign):
    assert ledger(times, (1, 1), (1, 1)).by_time == sign


@pytest.mark.parametrize(("dear", "sign"), [(1.03, UNDECIDED), (1.05, ORDERED), (0.97, UNDECIDED), (0.9, REVERSED)])
def test_time_of_loops_compiled_apart_decides_beyond_what_builds_differ_by(dear, sign):
    times = [{"x": near(1.0, 1e-4), "y": near(dear, 1e-4)}]
    counts = ({"x": Operations(1, 1), "y": Operations(1, 1)},)
    assert Ledger(times, counts, math.nan, MEASURABLE).stand("x", "y").by_time == sign


def test_time_decides_before_operations_and_the_two_are_said_to_disagree():
    stands = ledger([{"x": near(2.0), "y": near(1.0)}], (10, 0), (20, 0))
    assert (stands.sign, stands.by_operations, stands.is_disputed) == (REVERSED, ORDERED, True)


def test_columns_that_differ_are_put_together_by_the_price_alone():
    assert [ledger([], (40, 0), (30, 3), price).sign for price in (3.0, 4.0, math.nan)] == [
        REVERSED,
        ORDERED,
        UNDECIDED,
    ]


def test_price_of_a_call_is_what_times_were_made_with():
    counted = {name: Operations(*pair) for name, pair in COUNTS.items()}
    rows = [
        {"machine": "m", "arm": "", "contender": name, "ratio": 0.3 + FLOP * flops + CALL * calls}
        for name, (flops, calls) in COUNTS.items()
    ]
    frame = pd.DataFrame(rows).assign(ratio_low=0.0, ratio_high=0.0)
    assert price_of_a_call(times_of(frame), counted) == pytest.approx(CALL / FLOP)
    assert math.isnan(price_of_a_call(times_of(frame.iloc[1:]), counted))


def rows(controller, outcomes, **columns):
    """Episodes of a controller from starts 0, 1, ..., at which all is well but for what is given."""
    n = len(outcomes)
    usual = {"peak_torque_ratio": 0.5, "range_excess_rad": 0.0, "position_left_m": 0.0, "start_set": "uniform"}
    return pd.DataFrame(
        {"controller": controller, "arm": "a", "kp": 100.0, "start_id": range(n), "outcome": outcomes, **usual}
    ).assign(**columns)


SETTLED, LOST = "settled", "timed-out"


@pytest.mark.parametrize(
    ("columns", "expected"),
    [
        ({}, (True, True, True)),
        ({"peak_torque_ratio": 0.99}, (True, True, True)),
        ({"peak_torque_ratio": 1.0}, (True, False, False)),
        ({"range_excess_rad": 0.01}, (True, True, False)),
        ({"peak_torque_ratio": float("nan")}, (True, False, False)),
        ({"position_left_m": 0.1}, (True, True, True)),
        ({"position_left_m": 0.1, "start_set": "reach"}, (False, False, False)),
        ({"outcome": LOST}, (False, False, False)),
    ],
)
def test_each_measure_holds_those_before_it(columns, expected):
    assert tuple(passed(rows("one", [SETTLED], **columns)).iloc[0]) == expected


# Six of six on one side is p = 2/64 = 0.031, five of five 2/32 = 0.063; nine of ten 22/1024 = 0.021, eight 0.109.
@pytest.mark.parametrize(
    ("ones", "others", "expected"),
    [(6, 0, True), (0, 6, True), (5, 0, False), (9, 1, True), (8, 2, False), (0, 0, False)],
)
def test_two_are_told_apart_by_a_fair_coin(ones, others, expected):
    one = pd.Series([True] * ones + [False] * others + [True, False] * 20)
    other = pd.Series([False] * ones + [True] * others + [True, False] * 20)
    assert differs_significantly(one, other) is expected


def test_ties_have_no_winner_and_the_worse_are_left_out():
    table = pd.concat(
        [
            rows("b", [SETTLED] * 10),
            rows("a", [SETTLED] * 10),
            rows("nearly", [LOST] + [SETTLED] * 9),
            rows("worse", [LOST] * 6 + [SETTLED] * 4),
            rows("strong", [SETTLED] * 10, peak_torque_ratio=3.0),
        ]
    )
    assert best(table, "settled", "controller") == ["a", "b", "strong", "nearly"]
    assert best(table, "torque", "controller") == ["a", "b", "nearly"]


def test_controllers_are_compared_on_the_starts_that_both_ran():
    few = rows("few", [SETTLED] * 10).iloc[6:]
    assert best(pd.concat([rows("many", [LOST] * 6 + [SETTLED] * 4), few]), "range", "controller") == ["few", "many"]
