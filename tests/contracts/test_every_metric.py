"""Contracts that every metric keeps, of motion and in contact; a new file is under them without being named here."""

import dataclasses
import functools
import itertools
import math

import numpy as np
import pytest
from support.bits import different_rows, same_bits
from support.driving import ARM_METRICS, METRICS, NO_EARLY_STOP, settings, spread
from support.each import each
from support.on_arms import named
from support.states import vector

import tasks
from bench.engines import contact_episode
from bench.engines.arm_episode import ArmSample
from bench.engines.compiled import compile_on_demand
from bench.engines.contact_episode import WIDTH, EndedEpisode
from bench.engines.episode import FINAL_ANGLE, FIRST_METRIC, OUTCOME
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.metrics.metric import Ending
from bench.engines.metrics.registry import known_contact_metrics
from bench.engines.simulate import run
from bench.engines.simulate_arms import run_arm
from bench.engines.simulate_contact import run_contact
from bench.law.contenders.impedances import coordinates
from bench.law.contenders.registry import find_contender
from bench.law.contenders.representations import zyx_euler
from bench.law.control.contact_controller import hybrid, impedance_controller
from bench.law.so3 import Rotation
from tasks.verdict import OUTCOMES, SETTLED

GOOD_ENDINGS = [Ending(angle0=1.0, final_angle=1e-4, band=0.02, outcome=word) for word in OUTCOMES]
AT_GOAL = Ending(angle0=0.0, final_angle=0.0, band=0.02, outcome="settled")

metric = each(METRICS)
any_metric = each(ARM_METRICS)

NAN, INF = (math.nan,) * 7, (math.inf,) * 7
SPOILED = [
    *(
        {"margin": math.nan},
        {"before": NAN[:3]},
        {"u": NAN[:3]},
        {"u": INF[:3]},
        {"omega": (1e200,) * 3},
        {"p": NAN[:3]},
    ),
    *({"q": INF}, {"q": NAN}, {"qdot": NAN}, {"tau": NAN}, {"tau": (1e200,) * 7}, {"upper": (-1e200,) * 7}),
]


@functools.cache
def arm_samples() -> list[ArmSample]:
    """Return drawn samples, of a first joint that turns all round; then some with numbers that are huge or missing."""
    draw, found = np.random.default_rng(18), []
    for k in range(150):
        three = [vector(row) for row in draw.normal(scale=5.0, size=(8, 3))]
        q, qdot, tau, lower, upper, rated = draw.normal(scale=2.0, size=(6, 7))
        ranges = (-np.abs(lower), np.abs(upper))
        ranges[0][0], ranges[1][0] = -math.inf, math.inf
        share, margin = draw.uniform(0.0, 1.0, 2)
        seen = (np.float64(k), np.float64(1e-3), Rotation(*three[:3]), share, k > 50, k > 50, *three[3:6], margin)
        joints = map(vector, (q, qdot, tau, *ranges, 1.0 + np.abs(rated)))
        found.append(ArmSample(*seen, *three[6:], *joints))
    return [*found, *(found[100 + i]._replace(**fields) for i, fields in enumerate(SPOILED)), *found[:20]]


def test_metric_says_what_it_is_and_its_compiled_update_is_the_plain_one_bit_for_bit_on_an_arm(any_metric):
    assert any_metric.unit
    assert any_metric.title
    compiled = compile_on_demand(any_metric.update)
    with np.errstate(all="ignore"):
        plain, other = (
            list(itertools.accumulate(arm_samples(), update, initial=np.float64(any_metric.start)))
            for update in (any_metric.update, compiled)
        )
    assert same_bits(other, plain)
    assert len(np.unique(plain[:150])) > 1  # it has taken something in


@functools.cache
def rows_on_arm():
    """Episodes of the plain laws on an arm, some of which fail, by the metrics of arms."""
    starts = [tasks.start_set(word, arm="ur5e")[0] for word in tasks.task("arm-regulation", "ur5e").start_sets]
    words = ("rotation-matrix@geometric+solve", "feedback-linearized/zyx-euler@geometric+transpose")
    given = ("arm-regulation", "ur5e", starts, settings(dt_s=1e-2, horizon_s=1.0), ARM_METRICS)
    return np.vstack([run_arm("native", named("ur5e", word), *given) for word in words])


def test_finish_answers_a_number_or_nan_after_any_episode_on_an_arm(any_metric):
    column = FIRST_METRIC + ARM_METRICS.index(any_metric)
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


IN_CONTACT = list(known_contact_metrics().values())
EULER = zyx_euler.REPRESENTATION
CONTROLLERS = [
    hybrid("hybrid", "inverse", EULER),
    impedance_controller(coordinates.IMPEDANCE, EULER),
    hybrid("hybrid-base", "inverse"),
]
SUFFIXES = {"1": "", "rad": "_rad", "m": "_m", "s": "_s", "N": "_n", "N m": "_nm", "rad/(N m)": "_rad_per_nm"}
SUFFIXES |= {"J": "_j", "m/s": "_m_per_s", "rad/s": "_rad_per_s"}

touch = each(IN_CONTACT)


@functools.cache
def measured_poses() -> list[Pose]:
    """The second pose of every task with every controller, from a compiled run."""
    arm = tasks.arm("ur5e")
    found = []
    for name, controller in itertools.product(tasks.contact_names(), CONTROLLERS):
        task = tasks.contact_task(name)
        _, trials, *_ = (tuple(same) for _, same in itertools.groupby(task.trials(arm), lambda one: one.pose))
        ended = run_contact("native", controller, task, arm, trials)
        found.append(Pose(task, arm, controller, tuple(map(response, trials, ended))))
    return found


def broken_poses() -> list[Pose]:
    """Return poses whose records end at once, after a tick, and after a tick that is not finite."""
    records = [np.zeros((0, WIDTH)), np.zeros((1, WIDTH)), np.full((3, WIDTH), np.nan)]
    words = [word for word in contact_episode.OUTCOMES.values() if word != "done"]
    return [
        dataclasses.replace(
            pose,
            responses=tuple(
                response(one.trial, EndedEpisode(word, record)) for one in pose.responses
            ),
        )
        for pose in measured_poses()[:: len(CONTROLLERS)]
        for word, record in itertools.product(words, records)
    ]


def test_column_of_a_metric_ends_in_its_unit(touch):
    assert touch.column.endswith(SUFFIXES[touch.unit])
    assert touch.title
    assert touch.title[0].islower()


def test_metric_answers_a_number_or_nan_on_every_task_and_a_number_on_some(touch):
    answers = [touch.measure(pose) for pose in measured_poses()]
    assert all(isinstance(answer, float) for answer in answers)
    assert not any(math.isinf(answer) for answer in answers)
    assert np.isfinite(answers).any()


def test_metric_answers_a_number_or_nan_of_an_episode_that_broke_off_and_nan_where_nothing_was_recorded(touch):
    answers = [(len(pose.first.time), touch.measure(pose)) for pose in broken_poses()]
    assert all(isinstance(answer, float) for _, answer in answers)
    assert {math.isnan(answer) for ticks, answer in answers if not ticks} == {True}


def test_metric_leaves_the_record_as_it_is(touch):
    for pose in measured_poses():
        before = [array.copy() for one in pose.responses for array in one[2:-1]]
        touch.measure(pose)
        after = [array for one in pose.responses for array in one[2:-1]]
        assert all(np.array_equal(a, b) for a, b in zip(before, after, strict=True))
