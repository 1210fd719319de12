"""The comparison of laws: which rows it takes, what its tables say of made-up rows, and the springs against the run."""

import math

import pandas as pd
import pytest

from report.figures.comparison import comparison
from report.figures.kit import families

pytestmark = pytest.mark.usefixtures("reference")


def episode(contender, start, outcome="settled", time=1.0, **more):
    """A made-up row of a uniform start."""
    usual = {"arm": "", "start_set": "uniform", "kp": 100.0, "kv": 20.0, "angle0_rad": 1.0, "path_ratio": 1.0}
    turn = {"quat_w": 0.8, "quat_x": 0.6, "quat_y": 0.0, "quat_z": 0.0}
    return {**usual, **turn, "contender": contender, "start_id": start, "outcome": outcome} | {
        "settling_time_s": time if outcome == "settled" else math.nan,
        **more,
    }


def test_common_keeps_the_starts_that_every_law_ran():
    made = [episode("square-root", one) for one in "ab"] + [episode("rotation-matrix", one) for one in "abc"]
    kept = comparison.common(pd.DataFrame(made))
    assert list(kept["contender"]) == ["rotation-matrix"] * 2 + ["square-root"] * 2
    assert list(kept["start_id"]) == ["a", "b"] * 2


def test_costs_of_starts_that_do_not_settle_are_infinite():
    made = [episode("gibbs", "a", "stuck", effort=3.0), episode("gibbs", "b", effort=5.0)]
    table = comparison.costs(pd.DataFrame(made).astype({"contender": "category"}), "effort")
    assert table["gibbs"].tolist() == [math.inf, 5.0]


def test_interval_is_left_away_where_it_is_the_number():
    write = "{:.3f}".format
    assert comparison.spelled((0.5, 0.5, 0.5001), write) == "0.500"
    assert "(0.400 to never)" in comparison.spelled((0.5, 0.4, math.inf), write)


def test_law_of_no_family_comes_last_under_its_own_name():
    found = families.present(["my-law", "hybrid"])
    assert [one.title for one in found] == ["On the quaternion", families.OTHERS]
    assert found[-1].laws == {"my-law": "my-law"}


def test_an_orientation_counts_once_whatever_the_sign_of_its_quaternion():
    turns = pd.DataFrame([(0.6, 0.8, 0.0, 0.0), (-0.6, -0.8, 0.0, 0.0)], columns=[f"quat_{one}" for one in "wxyz"])
    assert len(comparison.orientation(turns).drop_duplicates()) == 1
