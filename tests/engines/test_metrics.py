"""The columns of an episode against numpy on the whole trajectory, recorded in dm_control's own loop."""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.driving import recorder, settings

import tasks
from bench.engines.episode import FINAL_ANGLE, FIRST_METRIC, OUTCOME
from bench.engines.metrics.metric import Ending
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate import run
from bench.law.contenders.registry import find_contender
from tasks.base import Start, angle
from tasks.rotations import zyx
from tasks.rules import RULES
from tasks.verdict import OUTCOMES

METRICS = metrics_of(on_arm=False)
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


@pytest.fixture(params=LAWS)
def word(request):
    return request.param


@pytest.fixture(params=STARTS, ids=lambda start: start.id)
def start(request):
    return request.param


def test_samples_are_the_ticks_of_the_episode(word, start):
    kept, _, _ = episode(word, start)
    np.testing.assert_allclose([s.time for s in kept], DT * np.arange(TICKS), rtol=2 * EPS)
    assert all(s.dt == DT for s in kept)
    assert math.sin(angle(start.quat_wxyz, start.goal_wxyz) / 2) ** 2 == pytest.approx(kept[0].haversine, rel=1e-14)


def test_samples_obey_the_plant(word, start):
    """MuJoCo's Euler: omega after a tick is omega + u dt (Murphy 1988, 2.6)."""
    kept, _, _ = episode(word, start)
    omega, u = np.array([s.omega for s in kept]), np.array([s.u for s in kept])
    # each tick turns omega into the body frame and back: some EPS of its size
    scale = 20 * EPS * max(1.0, np.abs(omega).max())
    np.testing.assert_allclose(omega[1:], omega[:-1] + DT * u[:-1], rtol=0.0, atol=scale)


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


def test_min_margin_is_the_smallest_cosine_of_beta_measured_from_the_goal_where_the_law_is(start):
    goal = ScipyRotation.from_quat(start.goal_wxyz, scalar_first=True)
    for word, frame in zip(LAWS[1:], (ScipyRotation.identity(), goal), strict=True):
        kept, found, _ = episode(word, start)
        margins = np.hypot(*frame.inv().apply([s.R.n for s in kept])[:, :2].T)
        assert found["min_margin"] == pytest.approx(margins.min(), abs=10 * EPS)


def test_min_margin_is_no_number_for_a_law_without_coordinates(start):
    assert math.isnan(episode("rotation-matrix", start)[1]["min_margin"])


def test_path_ratio_is_no_number_for_a_start_at_its_goal():
    assert math.isnan(episode("rotation-matrix", Start("at the goal", (1.0, 0.0, 0.0, 0.0)))[1]["path_ratio"])
