"""The columns of episodes against numpy on whole trajectories, recorded in dm_control's own loop."""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.driving import ARM_METRICS, METRICS, recorder, settings
from support.each import each
from support.on_arms import named

import tasks
from bench.engines.episode import FINAL_ANGLE, FIRST_METRIC, OUTCOME
from bench.engines.metrics.metric import Ending
from bench.engines.simulate import run
from bench.engines.simulate_arms import run_arm
from bench.law.contenders.registry import find_contender
from tasks.base import Start, angle
from tasks.kinematics import kinematics
from tasks.rotations import zyx
from tasks.rules import RULES
from tasks.verdict import OUTCOMES

DT = 2e-3
CHOSEN = settings(dt_s=DT, horizon_s=1.0)
TICKS = CHOSEN.ticks
# Sums of as many positive terms as there are ticks, in another order: half a last place each.
TOLERANCE = TICKS * EPS

STARTS = [
    Start("rest", zyx(1.0, -0.5, 0.8)),
    Start("tumbling", zyx(-0.6, 0.4, 0.5), (6.0, -8.0, 5.0)),
    # (0.5 + (5 - 10) t) exp(-10 t) about x: through the goal at 0.1 s, 0.07 rad beyond it at 0.2 s
    Start("through the goal", zyx(0.0, 0.0, 0.5), (-10.0, 0.0, 0.0)),
    Start("towards a goal", zyx(0.3, 0.2, -1.0), (1.0, 0.0, -2.0), zyx(-0.2, 0.3, 0.4)),
    tasks.start_set("uniform", 3, seed=19)[2],
]
LAWS = ("rotation-matrix", "linearized-euler/zyx-euler", "linearized-euler-relative/zyx-euler")


@functools.cache
def episode(word, start):
    """(samples, {metric: column}, the row) of one episode of the reference engine."""
    kept: list = []
    row = run("reference", find_contender(word), "free-body", [start], CHOSEN, (*METRICS, recorder(kept)))[0]
    angle0 = angle(start.quat_wxyz, start.goal_wxyz)
    ending = Ending(angle0, row[FINAL_ANGLE], RULES.band_rad(angle0), OUTCOMES[int(row[OUTCOME])])
    finished = {
        metric.column: metric.finish(float(value), ending)
        for metric, value in zip(METRICS, row[FIRST_METRIC:-1], strict=True)
    }
    return kept, finished, ending


word = each(LAWS)
start = each(STARTS)


def test_samples_are_the_ticks_of_the_episode(word, start):
    kept, _, _ = episode(word, start)
    np.testing.assert_allclose([s.time for s in kept], DT * np.arange(TICKS), rtol=2 * EPS)
    assert all(s.dt == DT for s in kept)
    assert math.sin(angle(start.quat_wxyz, start.goal_wxyz) / 2) ** 2 == pytest.approx(kept[0].haversine, rel=1e-14)


def norms(vectors):
    return np.linalg.norm(vectors, axis=1)


def angles_of(kept):
    return 2.0 * np.arcsin(np.sqrt([s.haversine for s in kept]))


def change_at_rest(kept, ending):
    """The largest change of the command from tick to tick since the body is at rest inside the band."""
    slow = norms([s.omega for s in kept]) * RULES.hold_s <= 2.0 * math.sin(ending.band / 2.0)
    busy = np.flatnonzero(~(slow & (angles_of(kept) <= ending.band)))[-1]
    changes = norms(np.diff([s.u for s in kept[busy:]], axis=0))
    return changes.max() if ending.outcome == "settled" else math.nan


def overshoot(kept, ending):
    """The largest angle outside the band after it was entered."""
    inside = np.flatnonzero(angles_of(kept) <= ending.band)
    after = angles_of(kept)[inside[0] :].max() if len(inside) else 0.0
    return after if after > ending.band else 0.0


EXPECTED = {
    "effort": lambda kept, ending: (norms([s.u for s in kept]) ** 2).sum() * DT,
    "peak_u": lambda kept, ending: norms([s.u for s in kept]).max(),
    "rest_change": change_at_rest,
    "path_ratio": lambda kept, ending: norms([s.omega for s in kept]).sum() * DT / ending.angle0,
    "overshoot_rad": overshoot,
}


@pytest.mark.parametrize("column", EXPECTED)
def test_column_is_numpys_over_all_ticks(column, word, start):
    kept, found, ending = episode(word, start)
    assert found[column] == pytest.approx(EXPECTED[column](kept, ending), rel=TOLERANCE, nan_ok=True)


def test_some_episode_overshoots_and_some_does_not():
    found = [episode(word, start)[1]["overshoot_rad"] for word in LAWS for start in STARTS]
    assert min(found) == 0.0
    assert max(found) > 0.05


def test_min_margin_is_the_smallest_cosine_of_beta_measured_from_the_goal_where_the_law_is_and_none_on_R(start):
    goal = ScipyRotation.from_quat(start.goal_wxyz, scalar_first=True)
    for word, frame in zip(LAWS[1:], (ScipyRotation.identity(), goal), strict=True):
        kept, found, _ = episode(word, start)
        margins = np.hypot(*frame.inv().apply([s.R.n for s in kept])[:, :2].T)
        assert found["min_margin"] == pytest.approx(margins.min(), abs=10 * EPS)
    assert math.isnan(episode("rotation-matrix", start)[1]["min_margin"])


def test_path_ratio_is_no_number_for_a_start_at_its_goal():
    assert math.isnan(episode("rotation-matrix", Start("at the goal", (1.0, 0.0, 0.0, 0.0)))[1]["path_ratio"])


CHOSEN_ON_ARM = settings(dt_s=DT, horizon_s=0.12)
ARM_CASES = [
    (arm, word, name)
    for arm in ("ur5e", "panda")
    for word in ("rotation-matrix@geometric+standard", "rotation-matrix@geometric+transpose")
    for name in ("clear", "wrist", "tumbling")
    if (arm, name) != ("panda", "wrist")  # whose starts take three seconds to find
]


@functools.cache
def episode_on_arm(arm, word, start_set):
    """(samples, {metric: column}) of one episode of the reference engine."""
    kept: list = []
    start = tasks.start_set(start_set, 2, arm=arm)[1]
    given = ("arm-regulation", arm, [start], CHOSEN_ON_ARM, (*ARM_METRICS, recorder(kept)))
    row = run_arm("reference", named(arm, word), *given)[0]
    ending = Ending(1.0, row[FINAL_ANGLE], 0.02, OUTCOMES[int(row[OUTCOME])])
    values = row[FIRST_METRIC : FIRST_METRIC + len(ARM_METRICS)]
    return kept, {one.column: one.finish(float(value), ending) for one, value in zip(ARM_METRICS, values, strict=True)}


@pytest.fixture(params=ARM_CASES, ids=lambda case: "-".join(case))
def seen(request):
    """(arm, samples, columns)."""
    arm, *rest = request.param
    return tasks.arm(arm), *episode_on_arm(arm, *rest)


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


EXPECTED_ON_ARM = {
    "position_error_m": lambda kept, arm: np.linalg.norm([np.subtract(s.p, s.p_d) for s in kept], axis=1).max(),
    "peak_tau_nm": lambda kept, arm: np.abs([s.tau for s in kept]).max(),
    "peak_torque_ratio": lambda kept, arm: np.max([np.abs(s.tau[: arm.joints]) / arm.rated for s in kept]),
    "range_excess_rad": excess,
}


@pytest.mark.parametrize("column", EXPECTED_ON_ARM)
def test_column_of_an_arm_is_numpys_over_all_ticks(column, seen):
    arm, kept, found = seen
    assert found[column] == pytest.approx(EXPECTED_ON_ARM[column](kept, arm), rel=8 * EPS, abs=1e-300)


@pytest.fixture(scope="module")
def sample():
    return episode_on_arm(*ARM_CASES[0])[0][0]


def update(name):
    return next(one for one in ARM_METRICS if one.column == name)


def test_range_excess_is_seen_below_and_above_and_not_where_there_is_no_range(sample):
    metric = update("range_excess_rad")
    inside = sample._replace(q=(0.0,) * 7, lower=(-1.0, -math.inf, *[-2.0] * 5), upper=(1.0, math.inf, *[2.0] * 5))
    assert metric.update(metric.start, inside) == 0.0
    assert metric.update(metric.start, inside._replace(q=(1.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))) == 0.25
    assert metric.update(metric.start, inside._replace(q=(0.0, 0.0, 0.0, 0.0, 0.0, -2.5, 0.0))) == 0.5
    assert metric.update(metric.start, inside._replace(q=(0.0, 1e6, 0.0, 0.0, 0.0, 0.0, 0.0))) == 0.0


@pytest.mark.parametrize(
    "name", ["peak_u", "min_margin", "peak_tau_nm", "peak_torque_ratio", "range_excess_rad", "position_error_m"]
)
def test_extreme_passes_over_a_tick_that_is_not_a_number(name, sample):
    """The tick at which a controller fails has torques and states that are none."""
    metric = update(name)
    nothing = (math.nan,) * 7
    missing = sample._replace(tau=nothing, q=nothing, p=nothing[:3], u=nothing[:3], margin=math.nan)
    seen = metric.update(metric.start, sample)
    assert metric.update(seen, missing) == seen
