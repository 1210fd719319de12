"""Contracts that every metric in bench/metrics/motion keeps; a new file is under them without being named here."""

import functools
import math

import numpy as np
import pytest
from support.bits import different_rows, same_bits
from support.driving import NO_EARLY_STOP, settings, spread
from support.on_arms import named

import tasks
from bench.contenders.registry import find_contender
from bench.engines.arm_episode import ArmSample
from bench.engines.compiled import MATRIX, compile_function
from bench.engines.episode import FINAL_ANGLE, FIRST_METRIC, OUTCOME
from bench.engines.simulate import run
from bench.engines.simulate_arms import run_arm
from bench.law.so3 import Rotation
from bench.metrics.metric import Ending
from bench.metrics.registry import metrics_of
from tasks.verdict import OUTCOMES, SETTLED

METRICS, ON_ARM = metrics_of(on_arm=False), metrics_of(on_arm=True)
GOOD_ENDINGS = [Ending(angle0=1.0, final_angle=1e-4, band=0.02, outcome=word) for word in OUTCOMES]
AT_GOAL = Ending(angle0=0.0, final_angle=0.0, band=0.02, outcome="settled")


@pytest.fixture(params=METRICS, ids=lambda metric: metric.column)
def metric(request):
    return request.param


@pytest.fixture(params=ON_ARM, ids=lambda metric: metric.column)
def any_metric(request):
    return request.param


def samples() -> np.ndarray:
    """Rows of numbers of a sample: drawn ones, then huge and missing ones."""
    draw = np.random.default_rng(18)
    rows = draw.normal(scale=5.0, size=(200, 19))
    rows[:, 1] = 1e-3  # dt
    rows[:, 11] = draw.uniform(0.0, 1.0, 200)  # haversine
    rows[:, 12] = np.arange(200) > 50  # entered
    rows[:, 18] = draw.uniform(0.0, 1.0, 200)  # margin
    rows[150:160, 18] = math.nan
    rows[160:170, 15] = math.nan
    rows[170:180, 16] = math.inf
    rows[180:190, 13] = 1e200
    return rows


def arm_samples() -> np.ndarray:
    """The same, and p, p_d, q, qdot, tau, lower, upper and rated; then missing, huge and unlimited ones."""
    draw = np.random.default_rng(19)
    more = draw.normal(scale=2.0, size=(200, 6 + 7 * 6))
    more[:, 27:34] = -np.abs(more[:, 27:34])  # lower
    more[:, 34:41] = np.abs(more[:, 34:41])  # upper
    more[:, 41:48] = 1.0 + np.abs(more[:, 41:48])  # rated
    more[150:160, 8], more[160:170, 15], more[170:180, 22] = math.nan, math.inf, math.nan
    more[180:185, 0], more[185:190, 20:27] = 1e200, -1e200
    more[:, 27], more[:, 34] = -math.inf, math.inf  # a joint that turns all round
    return np.hstack((samples(), more))


def folding(update):
    """The metric's value after every sample of an arm, as one function of rows."""

    def fold(given, out):
        value = out[0, 0]
        for k in range(given.shape[0]):
            s = given[k]
            R = Rotation((s[2], s[3], s[4]), (s[5], s[6], s[7]), (s[8], s[9], s[10]))
            omega, u = (s[13], s[14], s[17]), (s[15], s[16], s[0])
            sample = ArmSample(
                s[0], s[1], R, s[11], s[12] > 0.5, s[12] > 0.5, omega, u, omega, s[18],
                (s[19], s[20], s[21]), (s[22], s[23], s[24]),
                (s[25], s[26], s[27], s[28], s[29], s[30], s[31]), (s[32], s[33], s[34], s[35], s[36], s[37], s[38]),
                (s[39], s[40], s[41], s[42], s[43], s[44], s[45]), (s[46], s[47], s[48], s[49], s[50], s[51], s[52]),
                (s[53], s[54], s[55], s[56], s[57], s[58], s[59]), (s[60], s[61], s[62], s[63], s[64], s[65], s[66]),
            )  # fmt: skip
            value = update(value, sample)
            out[k, 0] = value

    return fold


def test_metric_says_its_unit_and_what_it_is(any_metric):
    assert any_metric.unit
    assert any_metric.title


def test_compiled_update_is_the_plain_update_bit_for_bit_on_an_arm(any_metric):
    given = arm_samples()
    plain, compiled = np.full((2, len(given), 1), any_metric.start)
    fold = folding(any_metric.update)
    with np.errstate(all="ignore"):
        fold(given, plain)
    compile_function(fold, (MATRIX, MATRIX), cache=False)(given, compiled)
    assert same_bits(compiled, plain)
    assert len(np.unique(plain[:150])) > 1  # it has taken something in


@functools.cache
def rows_on_arm():
    """Episodes of the plain laws on an arm, some of which fail, by the metrics of arms."""
    starts = [tasks.start_set(word, arm="ur5e")[0] for word in tasks.task("arm-regulation", "ur5e").start_sets]
    words = ("rotation-matrix@geometric+solve", "feedback-linearized/zyx-euler@geometric+transpose")
    given = ("arm-regulation", "ur5e", starts, settings(dt_s=1e-2, horizon_s=1.0), ON_ARM)
    return np.vstack([run_arm("native", named("ur5e", word), *given) for word in words])


def test_finish_answers_a_number_or_nan_after_any_episode_on_an_arm(any_metric):
    column = FIRST_METRIC + ON_ARM.index(any_metric)
    rows = rows_on_arm()
    assert len(set(rows[:, OUTCOME])) > 1
    for row in rows:
        outcome = int(row[OUTCOME])
        answer = any_metric.finish(float(row[column]), Ending(1.0, float(row[FINAL_ANGLE]), 0.02, OUTCOMES[outcome]))
        assert isinstance(answer, float)
        assert outcome != SETTLED or not math.isinf(answer)


@pytest.mark.parametrize("ending", [*GOOD_ENDINGS, AT_GOAL], ids=lambda ending: f"{ending.outcome}-{ending.angle0}")
def test_finish_answers_a_number_or_nan_even_if_no_tick_was_seen(any_metric, ending):
    answer = any_metric.finish(any_metric.start, ending)
    assert isinstance(answer, float)
    assert not math.isinf(answer)


@functools.cache
def columns_of(engine, word, each, dt_s, horizon_s, hold_ticks=NO_EARLY_STOP):
    """Outcomes, and every metric's fold: one compiled loop for all of them."""
    chosen = settings(dt_s=dt_s, horizon_s=horizon_s, hold_ticks=hold_ticks)
    rows = run(engine, find_contender(word), "free-body", spread(each), chosen, METRICS)
    folds = {metric: rows[:, FIRST_METRIC + i] for i, metric in enumerate(METRICS)}
    return rows[:, OUTCOME].astype(int), folds


def test_early_stop_changes_the_metric_of_a_settled_episode_by_a_thousandth_at_most(metric):
    """After the hold window less than a hundredth of the 2 % band is left to go: 2e-4 of the way."""
    (outcomes, to_the_end), (_, stopped) = (
        columns_of("ideal-rk4", "rotation-matrix", 2, 5e-3, 4.0, hold) for hold in (NO_EARLY_STOP, 50)
    )
    settled = outcomes == SETTLED
    assert settled.sum() > 5
    np.testing.assert_allclose(stopped[metric][settled], to_the_end[metric][settled], rtol=1e-3, atol=1e-9)


def test_metric_does_not_see_the_other_metrics(metric):
    starts, chosen = spread(1), settings(dt_s=1e-2, horizon_s=0.2)
    law = find_contender("rotation-matrix")
    together = run("reference", law, "free-body", starts, chosen, METRICS)[:, FIRST_METRIC + METRICS.index(metric)]
    alone = run("reference", law, "free-body", starts, chosen, [metric])[:, FIRST_METRIC]
    assert different_rows(together, alone) == []
