"""Gains at equal peak command, against closed forms of the springs and the commands that episodes saw."""

import math

import numpy as np
import pytest
from support.driving import settings

import tasks
from bench.engines.episode import FIRST_METRIC
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate import run
from bench.experiments.equal_peak import gains_at, greatest_command
from bench.law.contenders.registry import all_contenders, find_contender

METRICS = metrics_of(on_arm=False)
SPRINGS = {
    "rotation-matrix": 1.0,
    "square-root": 2.0,
    "quaternion-shortest": 2.0,
    "hybrid": 2.0,
    "sliding": 2.0,
    "rotation-vector": math.pi,
    "mrp": 4.0,
}


@pytest.mark.parametrize(("word", "greatest"), SPRINGS.items())
def test_it_is_the_greatest_of_the_spring(word, greatest):
    one = find_contender(word)
    assert greatest_command(one) == pytest.approx(greatest, rel=1e-12)
    gains = gains_at(one, 200.0)
    assert gains.kp == pytest.approx(200.0 / greatest, rel=1e-12)
    assert gains.kv == pytest.approx(2.0 * math.sqrt(gains.kp), rel=1e-15)


@pytest.mark.parametrize("word", ["gibbs", "paielli-bach"])
def test_a_law_without_a_greatest_command_has_no_gains(word):
    assert gains_at(find_contender(word), 100.0) is None


BOUNDED = [one for one in all_contenders() if not one.regulator.in_engine and gains_at(one, 1.0) is not None]


@pytest.mark.parametrize("one", BOUNDED, ids=lambda one: one.name)
def test_at_rest_no_start_asks_for_more_and_one_asks_for_nearly_as_much(one):
    """Episodes of one tick show the first commands."""
    starts = [*tasks.start_set("uniform", 1000, seed=5), *tasks.start_set("half-turn"), *tasks.start_set("wraps")]
    rows = run("ideal-held", one, "free-body", starts, settings(horizon_s=1e-3, gains=gains_at(one, 300.0)), METRICS)
    peaks = np.sqrt(rows[:, FIRST_METRIC + [metric.column for metric in METRICS].index("peak_u")])
    room = 1.0 + 1e-4 if one.representation is None else 1.1  # of coordinates it is that of the starts looked at
    assert np.nanmax(peaks) <= 300.0 * room
    assert np.nanmax(peaks) >= 300.0 * 0.9
