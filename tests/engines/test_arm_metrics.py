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


def test_position_error_is_the_largest_distance_of_the_tool_from_its_place(seen):
    _, kept, found = seen
    away = np.linalg.norm([np.subtract(sample.p, sample.p_d) for sample in kept], axis=1)
    assert found["position_error_m"] == pytest.approx(away.max(), rel=8 * EPS, abs=1e-300)


def test_peak_tau_is_the_largest_torque_of_any_joint(seen):
    arm, kept, found = seen
    tau = np.array([sample.tau for sample in kept])
    assert found["peak_tau_nm"] == pytest.approx(np.abs(tau).max(), rel=4 * EPS)
    assert np.abs(tau[:, : arm.joints]).min(axis=1).max() > 0.0


def test_peak_torque_ratio_is_over_what_each_motor_is_rated_for(seen):
    arm, kept, found = seen
    ratios = [np.abs(sample.tau[: arm.joints]) / arm.rated for sample in kept]
    assert found["peak_torque_ratio"] == pytest.approx(np.max(ratios), rel=4 * EPS)


def test_range_excess_is_how_far_a_joint_went_beyond_its_range(seen):
    arm, kept, found = seen
    q = np.array([sample.q[: arm.joints] for sample in kept])
    excess = np.maximum(q - np.array(arm.upper), np.array(arm.lower) - q).max()
    assert found["range_excess_rad"] == pytest.approx(max(excess, 0.0), rel=4 * EPS)


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
