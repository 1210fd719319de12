"""Contracts that every metric in metrics/contact keeps, on every task in contact; a new file is under them."""

import functools
import itertools
import math

import numpy as np
import pytest

import tasks
from bench.engines.contact_episode import OUTCOMES, WIDTH, Ended
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.metrics.registry import known_contact_metrics
from bench.engines.simulate_contact import run_contact as run
from bench.law.contenders.impedances import coordinates
from bench.law.contenders.representations import zyx_euler
from bench.law.control.contact_controller import hybrid, impedance_controller

METRICS = list(known_contact_metrics().values())
EULER = zyx_euler.REPRESENTATION
CONTROLLERS = [
    hybrid("hybrid", "inverse", EULER),
    impedance_controller(coordinates.IMPEDANCE, EULER),
    hybrid("hybrid-base", "inverse"),
]
SUFFIXES = {"1": "", "rad": "_rad", "m": "_m", "s": "_s", "N": "_n", "N m": "_nm", "rad/(N m)": "_rad_per_nm"}
SUFFIXES |= {"J": "_j", "m/s": "_m_per_s", "rad/s": "_rad_per_s"}


@pytest.fixture(params=METRICS, ids=lambda metric: metric.column)
def metric(request):
    return request.param


def first_trials(task):
    """The trials of the second pose of a task."""
    poses = [tuple(same) for _, same in itertools.groupby(task.trials(tasks.arm("ur5e")), lambda one: one.pose)]
    return poses[1]


@functools.cache
def measured_poses() -> list[Pose]:
    """A pose of every task with every controller, from a compiled run."""
    arm = tasks.arm("ur5e")
    found = []
    for name, controller in itertools.product(tasks.contact_names(), CONTROLLERS):
        task = tasks.contact_task(name)
        trials = first_trials(task)
        ended = run("native", controller, task, arm, trials)
        found.append(Pose(task, arm, controller, tuple(map(response, trials, ended))))
    return found


def broken_poses() -> list[Pose]:
    """Return poses whose records end at once, after a tick, and after a tick that is not finite."""
    records = [np.zeros((0, WIDTH)), np.zeros((1, WIDTH)), np.full((3, WIDTH), np.nan)]
    words = [word for word in OUTCOMES.values() if word != "done"]
    return [
        pose._replace(responses=tuple(response(one.trial, Ended(word, record)) for one in pose.responses))
        for pose in measured_poses()[:: len(CONTROLLERS)]
        for word, record in itertools.product(words, records)
    ]


def test_column_of_a_metric_ends_in_its_unit(metric):
    assert metric.column.endswith(SUFFIXES[metric.unit])
    assert metric.title
    assert metric.title[0].islower()


def test_metric_columns_are_distinct():
    assert len({metric.column for metric in METRICS}) == len(METRICS)


def test_metric_answers_a_number_or_nan_on_every_task(metric):
    answers = [metric.measure(pose) for pose in measured_poses()]
    assert all(isinstance(answer, float) for answer in answers)
    assert not any(math.isinf(answer) for answer in answers)


def test_metric_has_a_meaning_on_some_task(metric):
    assert np.isfinite([metric.measure(pose) for pose in measured_poses()]).any()


def test_metric_answers_a_number_or_nan_of_an_episode_that_broke_off_and_nan_where_nothing_was_recorded(metric):
    answers = [(len(pose.first.time), metric.measure(pose)) for pose in broken_poses()]
    assert all(isinstance(answer, float) for _, answer in answers)
    assert {math.isnan(answer) for ticks, answer in answers if not ticks} == {True}


def test_metric_leaves_the_record_as_it_is(metric):
    for pose in measured_poses():
        before = [array.copy() for one in pose.responses for array in one[2:-1]]
        metric.measure(pose)
        after = [array for one in pose.responses for array in one[2:-1]]
        assert all(np.array_equal(a, b) for a, b in zip(before, after, strict=True))
