"""Episodes on an arm that rounding decides are told from those that it does not."""

import numpy as np
import pandas as pd
import pytest

import tasks
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.experiments.experiment import rows_of
from bench.experiments.rounding import BESIDE, CHANGE, NUDGE, judged_on_both_sides, nudged
from bench.law.contenders.registry import find_contender

START = tasks.start_set("clear", 1, arm="ur5e")[0]


def row(outcome="settled", effort=1.0, condition=1e4):
    return {"outcome": outcome, "effort": effort, "cond_jacobian_max": condition, "peak_torque_ratio": 0.5}


def judged(first, plus, minus):
    """What is said of one row, given those of the start's two neighbours; and which starts were asked for."""
    asked, sides = [], iter((plus, minus))

    def again(starts):
        asked.extend(starts)
        return pd.DataFrame([next(sides)])

    [found] = judged_on_both_sides(pd.DataFrame([first]), [START], again).to_dict("records")
    return found, asked


def test_doubtful_row_is_judged_on_both_sides_of_its_start():
    found, asked = judged(row(), row(), row())
    assert asked == [nudged(START, NUDGE), nudged(START, -NUDGE)]
    assert (found[BESIDE], found[CHANGE]) == ("", 0.0)


def test_row_far_from_any_singularity_is_not_judged_again():
    found, asked = judged(row(condition=10.0), row("stuck"), row("stuck"))
    assert asked == []
    assert found[BESIDE] == ""
    assert np.isnan(found[CHANGE])


def test_torque_far_beyond_the_rated_one_is_doubtful_too():
    found, _ = judged(row(condition=10.0) | {"peak_torque_ratio": 1e3}, row("stuck"), row())
    assert found[BESIDE] == "stuck"


@pytest.mark.parametrize("sides", [(row("saturated"), row()), (row(), row("saturated"))])
def test_outcome_of_either_side_is_kept_if_it_is_another_one(sides):
    assert judged(row(), *sides)[0][BESIDE] == "saturated"


@pytest.mark.parametrize(
    ("first", "plus", "minus", "change"),
    [
        (1.0, 1.0 + 1e-4, 1.0 - 1e-3, pytest.approx(1e-3)),  # the largest relative one
        (1.0, np.nan, 1.0, np.inf),  # a number that is there on one side alone
        (1e-12, 5e-10, 0.0, 0.0),  # of the size of rounding
    ],
)
def test_change_is_the_largest_relative_one_of_numbers_above_rounding(first, plus, minus, change):
    assert judged(row(effort=first), row(effort=plus), row(effort=minus))[0][CHANGE] == change


def test_run_marks_what_passes_a_singularity_and_nothing_in_the_clear():
    plan = planning.make(
        "quick",
        [find_contender("rotation-matrix")],
        Choice(("arm-regulation",), ("clear", "wrist"), ("native",), ("ur5e",), ("geometric",), ("solve",)),
        count=8,
        horizon_s=3.0,
    )
    found = pd.concat([rows_of(plan.settings, unit) for unit in plan.of("arm")])
    doubtful = found[CHANGE].notna()
    assert not doubtful[found["start_set"] == "clear"].any()
    assert doubtful[found["start_set"] == "wrist"].any()
    assert (found.loc[doubtful & (found[BESIDE] == ""), CHANGE] > 0.0).all()
