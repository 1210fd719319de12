"""The columns that only arms have against numpy on the whole trajectory, recorded in dm_control's own loop."""

import functools
import math

import numpy as np
import pytest
from support.bits import EPS
from support.driving import recorder, settings
from support.on_arms import named

import tasks
from bench.engines.episode import FINAL_ANGLE, FIRST_METRIC, OUTCOME
from bench.engines.metrics.metric import Ending
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate_arms import run_arm as run
from tasks.kinematics import kinematics
from tasks.verdict import OUTCOMES

METRICS = metrics_of(on_arm=True)
DT, TICKS = 2e-3, 60
CHOSEN = settings(dt_s=DT, horizon_s=DT * TICKS)
CASES = [
    (arm, word, name)
    for arm in ("ur5e", "panda")
    for word in ("rotation-matrix@geometric+standard", "rotation-matrix@geometric+transpose")
    for name in ("clear", "wrist", "tumbling")
]


@functools.cache
def episode(arm, word, start_set):
    """(samples, {metric: column}) of one episode of the reference engine."""
    kept: list = []
    start = tasks.start_set(start_set, 2, arm=arm)[1]
    given = ("arm-regulation", arm, [start], CHOSEN, (*METRICS, recorder(kept)))
    row = run("reference", named(arm, word), *given)[0]
    ending = Ending(1.0, row[FINAL_ANGLE], 0.02, OUTCOMES[int(row[OUTCOME])])
    values = row[FIRST_METRIC : FIRST_METRIC + len(METRICS)]
    return kept, {one.column: one.finish(float(value), ending) for one, value in zip(METRICS, values, strict=True)}


@pytest.fixture(params=CASES, ids=lambda case: "-".join(case))
def seen(request):
    """(arm, samples, columns)."""
    arm, *rest = request.param
    return tasks.arm(arm), *episode(arm, *rest)


def test_samples_are_the_arms_states(seen):
    arm, kept, _ = seen
    model = kinematics(arm)
    for sample in kept[::10]:
        p, _ = model.pose(sample.q[: arm.joints])
        np.testing.assert_allclose(sample.p, p, rtol=0.0, atol=1e-12)
        assert sample.q[arm.joints :] == sample.qdot[arm.joints :] == (0.0,) * (7 - arm.joints)
        assert sample.p_d == kept[0].p
    q, qdot = (np.array([getattr(sample, name) for sample in kept]) for name in ("q", "qdot"))
    # MuJoCo's semi-implicit Euler: q after a tick is q + qdot dt of the rates after it
    np.testing.assert_allclose(q[1:], q[:-1] + DT * qdot[1:], rtol=0.0, atol=8 * EPS * max(1.0, np.abs(q).max()))


def excess(kept, arm):
    q = np.array([sample.q[: arm.joints] for sample in kept])
    return max(np.maximum(q - np.array(arm.upper), np.array(arm.lower) - q).max(), 0.0)


EXPECTED = {
    "position_error_m": lambda kept, arm: np.linalg.norm([np.subtract(s.p, s.p_d) for s in kept], axis=1).max(),
    "peak_tau_nm": lambda kept, arm: np.abs([s.tau for s in kept]).max(),
    "peak_torque_ratio": lambda kept, arm: np.max([np.abs(s.tau[: arm.joints]) / arm.rated for s in kept]),
    "range_excess_rad": excess,
}


@pytest.mark.parametrize("column", EXPECTED)
def test_column_is_numpys_over_all_ticks(column, seen):
    arm, kept, found = seen
    assert found[column] == pytest.approx(EXPECTED[column](kept, arm), rel=8 * EPS, abs=1e-300)


SAMPLE = episode(*CASES[0])[0][0]


def update(name):
    return next(one for one in METRICS if one.column == name)


def test_range_excess_is_seen_below_and_above_and_not_where_there_is_no_range():
    metric = update("range_excess_rad")
    inside = SAMPLE._replace(q=(0.0,) * 7, lower=(-1.0, -math.inf, *[-2.0] * 5), upper=(1.0, math.inf, *[2.0] * 5))
    assert metric.update(metric.start, inside) == 0.0
    assert metric.update(metric.start, inside._replace(q=(1.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))) == 0.25
    assert metric.update(metric.start, inside._replace(q=(0.0, 0.0, 0.0, 0.0, 0.0, -2.5, 0.0))) == 0.5
    assert metric.update(metric.start, inside._replace(q=(0.0, 1e6, 0.0, 0.0, 0.0, 0.0, 0.0))) == 0.0


@pytest.mark.parametrize(
    "name", ["peak_u", "min_margin", "peak_tau_nm", "peak_torque_ratio", "range_excess_rad", "position_error_m"]
)
def test_extreme_passes_over_a_tick_that_is_not_a_number(name):
    """The tick at which a controller fails has torques and states that are none."""
    metric = update(name)
    nothing = (math.nan,) * 7
    missing = SAMPLE._replace(tau=nothing, q=nothing, p=nothing[:3], u=nothing[:3], margin=math.nan)
    seen = metric.update(metric.start, SAMPLE)
    assert metric.update(seen, missing) == seen
