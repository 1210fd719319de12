"""Figures and tables about Jacobians and whole controllers' costs, from a few poses of two arms and a few counts."""

import math
import re

import numpy as np
import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_drawn

from bench.engines.counting import rows_on_arm
from bench.experiments import jacobians as poses
from bench.experiments.experiment import Settings
from bench.experiments.tables.read import with_contender
from bench.findings.claims.probes import controller
from report.figures.arms import condition_maps, cost_on_arms, jacobians

ARMS = ("puma560", "panda")
WORDS = {
    6: (
        "rotation-matrix@geometric+solve",
        "rotation-matrix@geometric+damped-least-squares",
        "feedback-linearized/zyx-euler@geometric+solve",
        "feedback-linearized/zyx-euler@analytic+solve",
        "feedback-linearized/quaternion@analytic+pseudo-inverse",
    ),
    7: ("rotation-matrix@geometric+pseudo-inverse",),
}


@pytest.fixture(scope="module")
def seen():
    """poses.parquet of two arms, as it would be read."""
    frames = [poses.rows(Settings(), poses.of_arm(name, 24)) for name in ARMS]
    frame = pd.concat(frames, ignore_index=True)
    return frame.astype({"arm": "category", "pose_set": "category", "representation": "category"})


@pytest.fixture(scope="module")
def counted():
    """costs.parquet of a few controllers, as `cost_on_arms.counted` gives it."""
    frames = [pd.DataFrame(rows_on_arm(controller(word), n)) for n, words in WORDS.items() for word in words]
    table = with_contender(pd.concat(frames, ignore_index=True))
    return cost_on_arms.prepared(table[table["branch"] == "typical"])


def of(seen, pose_set="", representation=""):
    chosen = seen if not pose_set else seen[seen["pose_set"] == pose_set]
    return chosen if not representation else chosen[chosen["representation"] == representation]


def test_figure_says_its_numbers_keeps_to_the_palette_and_fits_a_phone(seen):
    assert_is_drawn(condition_maps.maps(of(seen, "slice", "zyx-euler")))


def test_stock_pose_is_well_conditioned_and_on_the_pole(seen):
    rows = of(seen, "named", "zyx-euler")
    said = jacobians.first_example(rows[(rows["arm"] == "puma560") & (rows["pose_id"] == "qn")])
    assert (said["qn_beta"], said["qn_J"]) == ("90°", "7.9")
    # how large, rounding decides, up to a one with nothing before its power of ten
    assert re.fullmatch(r"([2-9]·)?10[⁰¹²³⁴⁵⁶⁷⁸⁹]{2}", said["qn_zyx"])


def test_slice_is_put_back_on_its_grid(seen):
    rows = of(seen, "slice", "zyx-euler")
    rows = rows[rows["arm"] == "puma560"].sample(frac=1.0, random_state=0)
    grid = condition_maps.Grid(rows)
    at = rows.iloc[0]
    row, column = (int(word) for word in at["pose_id"].split("-")[2:])
    assert grid.condition[row, column] == pytest.approx(min(at["condition"], condition_maps.HIGHEST))
    assert grid.x[column] == pytest.approx(math.degrees(at[f"q_{grid.first}"]))
    assert grid.y[row] == pytest.approx(math.degrees(at[f"q_{grid.second}"]))
    assert np.isfinite(grid.condition).all()


def test_stages_add_up_to_the_total(counted):
    totals = counted[counted["stage"] == "total"].set_index("contender")["flops"]
    for joints in WORDS:
        own = cost_on_arms.standard(counted, joints)
        for name, row in cost_on_arms.stages(own).iterrows():
            assert row.sum() in totals[[one for one in totals.index if one.startswith(f"{name}+")]].tolist()


def test_quaternion_is_shown_with_the_inverse_that_fits_it(counted):
    shown = set(cost_on_arms.standard(counted, 6)["contender"])
    assert "feedback-linearized/quaternion@analytic+pseudo-inverse" in shown
    assert "rotation-matrix@geometric+damped-least-squares" not in shown
