"""Weak motors: the study's draw, its rows made again, and the counts of planted rows."""

import math

import pandas as pd
import pytest

from bench.findings.selection.checked import count_by_bound, count_weak_motors, read_weak_motors
from bench.studies.weak_motors import BOUNDS, COUNT, SEED, check, draw
from tasks.situation import read_situation


def test_rows_are_those_of_the_published_draw():
    assert read_weak_motors()["situation"].tolist() == [at.word for at in draw(COUNT, SEED)]


def test_least_time_is_known_for_every_situation_in_which_a_law_is_advised():
    rows = read_weak_motors()
    assert rows["bound"].between(*BOUNDS).all()
    assert rows.loc[rows["advised"] != "none", "least"].notna().all()
    assert rows["least"].notna().mean() > 0.9
    advised = rows[rows["advised"] != "none"]
    assert len(advised) > 0.8 * len(rows)
    assert (advised["time"] > advised["least"]).all()


def test_row_is_what_the_code_makes_now():
    rows = read_weak_motors()
    row = rows[rows["advised"] != "none"].sort_values("time").iloc[0]
    made = check(read_situation(row["situation"]))
    assert made["advised"] == row["advised"]
    assert made["time"] == pytest.approx(row["time"], rel=2e-3)
    assert made["least"] == pytest.approx(row["least"], rel=1e-6)


def plant(bound, advised, time, overshoot):
    """Return a row whose least time is 1 and whose linear loop takes 2."""
    return {
        "situation": str(bound),
        "bound": bound,
        "inertia": 1.0,
        "advised": advised,
        "time": time,
        "overshoot": overshoot,
        "least": 1.0,
        "linear": 2.0,
    }


PLANTED = pd.DataFrame(
    [
        plant(0.05, "hybrid", 1.1, 4.0),
        plant(0.06, "hybrid", 1.2, 6.0),
        plant(0.07, "none", math.inf, math.nan),
        plant(0.3, "mrp-memory", 3.0, 0.0),
    ]
)


def test_situations_are_counted_by_class_of_the_bound():
    weak, strong, every = count_by_bound(PLANTED)
    assert (weak.of, weak.advised, weak.near, weak.little) == (3, 2, 0.5, 0.5)
    assert (strong.of, strong.advised, strong.near, strong.little) == (1, 1, 0.0, 1.0)
    assert (every.low, every.high, every.of, every.advised) == (0.05, 0.3, 4, 3)
    assert every.ratio == pytest.approx(1.2)
    assert every.linear == 2.0


def test_a_law_at_the_very_limit_is_near_and_overshoots_too_much():
    found = count_weak_motors(pd.DataFrame([plant(0.1, "hybrid", 1.15, 5.0)]))
    assert (found.near, found.little) == (1.0, 0.0)
