"""Which controllers of arms are best, on tables typed by hand; McNemar's test against a table of the literature."""

import pandas as pd
import pytest

from bench.findings.on_arms import best, passed, told_apart


def rows(controller, outcomes, **columns):
    """Episodes of a controller from starts 0, 1, ..., at which all is well but for what is given."""
    n = len(outcomes)
    usual = {"peak_torque_ratio": 0.5, "range_excess_rad": 0.0, "position_left_m": 0.0, "start_set": "uniform"}
    return pd.DataFrame(
        {"controller": controller, "arm": "a", "start_id": range(n), "outcome": outcomes, **usual}
    ).assign(**columns)


SETTLED, LOST = "settled", "timed-out"


@pytest.mark.parametrize(
    ("columns", "expected"),
    [
        ({}, (True, True, True)),
        ({"peak_torque_ratio": 1.0}, (True, True, True)),
        ({"peak_torque_ratio": 1.01}, (True, False, False)),
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
    assert told_apart(one, other) is expected


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
