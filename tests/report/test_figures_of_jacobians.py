"""What the page on arms shows of Jacobians, from a few poses of two arms."""

import math
import re

import numpy as np
import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_drawn

from bench.experiments import jacobians as poses
from bench.experiments.experiment import Settings
from report.figures.arms import jacobians

ARMS = ("puma560", "panda")


@pytest.fixture(scope="module")
def seen():
    """poses.parquet of two arms, as it would be read."""
    frames = [poses.rows(Settings(), poses.of_arm(name, 24)) for name in ARMS]
    frame = pd.concat(frames, ignore_index=True)
    return frame.astype({"arm": "category", "pose_set": "category", "representation": "category"})


def of(seen, pose_set="", representation=""):
    chosen = seen if not pose_set else seen[seen["pose_set"] == pose_set]
    return chosen if not representation else chosen[chosen["representation"] == representation]


def test_figure_says_its_numbers_keeps_to_the_palette_and_fits_a_phone(seen):
    assert_is_drawn(jacobians.maps(of(seen, "slice", "zyx-euler")))


def test_stock_pose_is_well_conditioned_and_on_the_pole(seen):
    rows = of(seen, "named", "zyx-euler")
    said = jacobians.describe_first(rows[(rows["arm"] == "puma560") & (rows["pose_id"] == "qn")])
    # how large that of the angles is, rounding decides, up to a one with nothing before its power of ten
    assert re.search(r"number 7\.9; .* is ([2-9]·)?10[⁰¹²³⁴⁵⁶⁷⁸⁹]{2}, .* β = 90°", said)


def test_slice_is_put_back_on_its_grid(seen):
    rows = of(seen, "slice", "zyx-euler")
    rows = rows[rows["arm"] == "puma560"].sample(frac=1.0, random_state=0)
    grid = jacobians.Grid(rows)
    at = rows.iloc[0]
    row, column = (int(word) for word in at["pose_id"].split("-")[2:])
    assert grid.condition[row, column] == pytest.approx(min(at["condition"], jacobians.HIGHEST))
    assert grid.x[column] == pytest.approx(math.degrees(at[f"q_{grid.first}"]))
    assert grid.y[row] == pytest.approx(math.degrees(at[f"q_{grid.second}"]))
    assert np.isfinite(grid.condition).all()
