"""Rows of goal streams: the lag of the linear loop, laws that see no sign, and the spring that does."""

import functools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from bench.engines.simulate_bodies import run_stream as run
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.suites import STREAMED
from bench.law.contenders.registry import find_contender
from bench.law.inputs import PAPERS_GAINS
from tasks.rotations import about

AXIS, RATE, DT = (0.0, 0.0, 1.0), 0.5, 1e-3


@functools.cache
def rows():
    return rows_of(Settings("quick"), Unit("goal-streams", count=1, total=1)).set_index(["stream", "law"])


def test_body_behind_a_turning_goal_lags_as_the_linear_loop():
    truth = np.array([about(AXIS, RATE * k * DT) for k in range(1500)])
    seen = run(find_contender("rotation-vector"), truth, truth, PAPERS_GAINS, DT)
    kp, kv = PAPERS_GAINS
    found = solve_ivp(lambda _, x: (x[1], -kp * x[0] - kv * (x[1] + RATE)), (0.0, 1.5), (0.0, -RATE), rtol=1e-9)
    assert seen.off_rad == pytest.approx(np.abs(found.y[0]).max(), rel=0.02)
    assert seen.off_rad == pytest.approx(RATE * kv / kp, rel=0.02)


@pytest.mark.parametrize("law", STREAMED)
def test_law_on_matrices_sees_no_sign(law):
    right = rows().loc[("log", law)]
    np.testing.assert_allclose(rows().loc[("slerp-continued", law)].to_numpy(), right.to_numpy(), rtol=1e-9)
    for name in ("rotation-vector-continued", "quaternion-continued"):
        np.testing.assert_allclose(rows().loc[(name, law)].to_numpy(), right.to_numpy(), rtol=0.02)


def test_spring_on_the_quaternion_as_it_came_unwinds_where_its_sign_flips():
    raw = rows().xs("", level="law")
    assert (raw.loc[["quaternion", "slerp"], "way_ratio"] > 1.5).all()
    assert (raw.loc[["quaternion-continued", "slerp-continued"], "way_ratio"] < 1.0).all()
    assert (raw.loc[["quaternion", "slerp"], "off_rad"] > math.radians(150.0)).all()


def test_flip_raises_every_laws_peak_tenfold():
    peaks = rows()["peak_u"].drop("", level="law").unstack("stream")
    assert (peaks[["rotation-vector", "quaternion", "slerp"]].min(axis=1) > 10.0 * peaks["log"]).all()
