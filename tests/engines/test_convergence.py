"""The continuous plant by ever shorter steps: against integrators and a closed form that are not ours."""

import numpy as np
import pytest
from support.bodies import regulated
from support.driving import settings

import tasks
from bench.engines import simulate as engines
from bench.engines.convergence import alike
from bench.engines.episode import (
    FAILURE_TICK,
    FINAL_ANGLE,
    FIRST_METRIC,
    OUTCOME,
    SETTLING_TICK,
    STEP,
    start_rows,
)
from bench.experiments.map import start_rows as random_rows
from bench.law.contenders.registry import find_contender
from bench.law.inputs import PAPERS_GAINS
from tasks.random_starts import block
from tasks.rules import RULES
from tasks.verdict import CREEPING, DIVERGED, SATURATED, SETTLED

HOLD = RULES.hold_ticks(1e-3)
LINEARIZED, LINEAR = find_contender("linearized-euler/zyx-euler"), find_contender("feedback-linearized/zyx-euler")


def starts_of(name, *ids):
    return [start for start in tasks.start_set(name) if start.id in ids]


def test_response_through_the_pole_has_the_limit_that_an_adaptive_integrator_finds():
    """Figure 2.5 at 0.4 s: 1.1420 rad, and 1.1358 by steps of 1 ms, as independent code had it."""
    [start] = starts_of("paper", "figure-2.5")
    _, _, [angle] = regulated(LINEARIZED.law, start, [0.4], rtol=1e-12)
    found = [
        engines.on_ideal("ideal-rk4", LINEARIZED, start_rows([start]), settings(dt_s=dt, horizon_s=0.4), converge=False)
        for dt in (1e-3, 1e-3 / 2048)
    ]
    assert found[0][0, FINAL_ANGLE] == pytest.approx(1.1358, abs=1e-4)
    assert found[1][0, FINAL_ANGLE] == pytest.approx(angle, abs=1e-4)
    assert angle == pytest.approx(1.1420, abs=1e-4)


BESIDE = ("pole-plus-k03-a0.1-g0.2", "pole-minus-k04-a1.0-g-0.5", "pole-plus-k05-a-2.0-g1.0")


def test_stiff_start_beside_the_pole_settles_when_an_implicit_integrator_says_so():
    """BDF of scipy, whose step no stiffness bounds."""
    starts, chosen = starts_of("poles", *BESIDE), settings(horizon_s=3.0, hold_ticks=HOLD)
    coarse, fine = (
        engines.on_ideal("ideal-rk4", LINEARIZED, start_rows(starts), chosen, converge=one) for one in (0, 1)
    )
    assert len(starts) == len(BESIDE)
    assert (coarse[:, OUTCOME] != SETTLED).any()
    assert (fine[:, OUTCOME] == SETTLED).all()
    assert (fine[:, STEP] > 0.0).all()
    times = np.arange(0.0, 3.0, 1e-3)
    for start, row in zip(starts, fine, strict=True):
        _, _, angles = regulated(LINEARIZED.law, start, times, method="BDF", rtol=1e-9, atol=1e-12)
        since = len(times) - np.argmax((angles > 0.02 * angles[0])[::-1])
        assert abs(row[SETTLING_TICK] - since) <= 1


def find_crossing(quats, omegas):
    """Return whether the linear beta(t) of each start, exp(-w t) (beta_0 + v t), passes a pole."""
    w, x, y, z = quats.T
    nx, ny, nz = w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)
    flat, rate = np.hypot(nx, ny), PAPERS_GAINS.kv / 2.0
    beta, rising = np.arctan2(-nz, flat), (nx * omegas[:, 1] - ny * omegas[:, 0]) / flat
    beta, rising = np.where(rising < 0.0, -beta, beta), np.abs(rising)
    v = rising + rate * beta
    highest = np.exp(-rising / np.where(v > 0.0, v, 1.0)) * v / rate
    return (v > 0.0) & (highest > np.pi / 2.0)


def test_starts_without_a_limit_are_those_whose_linear_response_crosses_a_pole():
    """Feedback linearization at 20 rad/s: beta(t) in closed form knows which."""
    quats, omegas = (part[:4000] for part in block(0, 5, 20.0, 20.0))
    rows = engines.on_ideal("ideal-rk4", LINEAR, random_rows(quats, omegas), settings(horizon_s=5.0, hold_ticks=HOLD))
    crosses, apart, lost = find_crossing(quats, omegas), rows[:, STEP] < 0.0, rows[:, OUTCOME] != SETTLED
    assert not (apart & ~crosses).any()
    assert not (lost & ~crosses).any()
    assert apart.sum() >= 0.8 * crosses.sum() > 40


def row(outcome, settling=-1.0, failure=-1.0, angle=0.0, step=0.0):
    made = np.zeros((1, FIRST_METRIC))
    made[0, [OUTCOME, SETTLING_TICK, FAILURE_TICK, FINAL_ANGLE, STEP]] = outcome, settling, failure, angle, step
    return made


@pytest.mark.parametrize(
    ("coarse", "fine", "ticks", "expected"),
    [
        (row(SETTLED, 300), row(SETTLED, 301), 1, True),
        (row(SETTLED, 300), row(SETTLED, 302), 1, False),
        (row(SETTLED, 300), row(SETTLED, 598), 2, True),
        (row(SETTLED, 300), row(SETTLED, 602), 2, False),
        (row(SETTLED, 300), row(CREEPING), 1, False),
        (row(CREEPING, angle=1.0), row(CREEPING, angle=1.01), 1, True),
        (row(CREEPING, angle=1.0), row(CREEPING, angle=1.1), 1, False),
        (row(SATURATED, failure=0), row(SATURATED, failure=0), 2, True),
        (row(SATURATED, failure=3), row(SATURATED, failure=3), 2, False),
        (row(SATURATED, failure=3), row(DIVERGED, failure=9, step=1e-6), 1, True),
        (row(SATURATED, failure=3), row(SATURATED, failure=3, step=-1e-6), 1, False),
    ],
)
def test_episodes_are_alike_that_end_alike(coarse, fine, ticks, expected):
    assert alike(coarse, fine, ticks).tolist() == [expected]
