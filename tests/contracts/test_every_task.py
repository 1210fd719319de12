"""Contracts that every task in tasks/domains keeps, on every arm of tasks/arms; new files are under them unnamed."""

import itertools
import math

import numpy as np
import pytest
from mujoco import mjtDisableBit
from support.in_contact import ARMS
from support.states import rotation

import tasks
from tasks.base import Start, Task
from tasks.rules import ticks
from tasks.sensors import SENSORS

COUNT = 6  # starts of each set that every task is tried on


@pytest.fixture(params=tasks.pairs(), ids="-".join)
def task(request) -> Task:
    return tasks.task(*request.param)


def some_starts(task):
    return [start for name in task.start_sets for start in tasks.start_set(name, COUNT, arm=task.arm)]


def test_task_is_named_as_its_file_says_title_and_source_and_names_known_start_sets(task):
    assert (task.name, task.arm) in tasks.pairs()
    assert tasks.task(task.name, task.arm) is task
    assert task.title
    assert task.source
    assert task.start_sets
    assert set(task.start_sets) <= set(tasks.start_set_names(arm=bool(task.arm)))


def test_task_carries_the_sensors_in_order(task):
    model = tasks.load(task).physics.model
    names = [model.id2name(i, "sensor") for i in range(len(SENSORS))]
    assert names == ["n", "o", "a", "omega", "quat"]
    assert model.sensor_adr[: len(SENSORS)].tolist() == [0, 3, 6, 9, 12]
    assert model.sensor_dim[: len(SENSORS)].tolist() == [3, 3, 3, 3, 4]
    assert not model.sensor_cutoff[: len(SENSORS)].any()
    assert not model.sensor_noise[: len(SENSORS)].any()


@pytest.mark.parametrize("dt", [1e-3, 2e-3, 0.1 / 3.0])
def test_task_steps_by_dt_and_never_resets_by_itself(task, dt):
    environment = tasks.load(task, dt=dt, horizon=1.0)
    assert environment.physics.timestep() == dt
    assert environment.control_timestep() == dt
    assert environment.physics.model.opt.disableflags & mjtDisableBit.mjDSBL_AUTORESET


def test_first_observation_is_the_start_and_the_ground_truth(task):
    for start in some_starts(task):
        environment = tasks.load(task, start)
        first = environment.reset()
        for quat in (start.quat_wxyz, environment.physics.quat_wxyz()):
            R = rotation(quat).as_matrix()
            np.testing.assert_allclose(first.observation["R"].reshape(3, 3).T, R, rtol=0, atol=1e-14)
        np.testing.assert_allclose(first.observation["omega"], start.omega, rtol=0, atol=1e-13)
        assert tuple(first.observation["goal_quat"]) == start.goal_wxyz


def test_observation_has_three_arrays_and_those_of_the_joints_and_no_more(task):
    shapes = {"R": (9,), "omega": (3,), "goal_quat": (4,)}
    if task.arm:
        n = tasks.arm(task.arm).joints
        shapes |= {"q": (n,), "qdot": (n,), "p": (3,)}
    observation = tasks.load(task).reset().observation
    assert {name: value.shape for name, value in observation.items()} == shapes


def test_reward_is_minus_the_angle_to_the_goal(task):
    for start in some_starts(task)[::5]:
        environment = tasks.load(task, start)
        environment.reset()
        reward = environment.step(np.zeros(environment.action_spec().shape)).reward
        quat, goal = map(rotation, (environment.physics.quat_wxyz(), start.goal_wxyz))
        assert reward == pytest.approx(-(goal.inv() * quat).magnitude(), abs=1e-14)


@pytest.mark.parametrize(("name", "arm"), [*tasks.pairs(), *itertools.product(tasks.contact_names(), ARMS)])
def test_agent_that_acts_at_random_within_the_motors_bounds_runs_on(name, arm):
    environment = tasks.load(name, arm=arm)
    most, random, step = environment.action_spec().maximum, np.random.default_rng(0), environment.reset()
    assert most.tolist() == list(tasks.arm(arm).rated if arm else (1000.0,) * 3)
    assert (environment.action_spec().minimum == -most).all()
    for _ in range(1000):
        step = environment.reset() if step.last() else environment.step(random.uniform(-most, most))
        assert all(np.isfinite(seen).all() for seen in step.observation.values())
    environment.reset()
    environment.step(2.0 * most)
    assert environment.physics.data.actuator_force.tolist() == (2.0 * most).tolist()  # nothing is cut


@pytest.mark.parametrize(("dt", "horizon"), [(1e-3, 0.05), (0.1, 0.3), (0.1, 1.1), (0.1 / 3, 0.2)])
def test_episode_ends_at_the_horizon_and_no_earlier(task, dt, horizon):
    environment = tasks.load(task, dt=dt, horizon=horizon)
    step, count = environment.reset(), 0
    while not step.last():
        # an arm is held up, as a tenth of a second is too long a step for one that falls
        weight = environment.physics.data.qfrc_bias if task.arm else np.zeros(environment.action_spec().shape)
        step = environment.step(np.array(weight))
        count += 1
    assert count == ticks(horizon, dt)


@pytest.mark.parametrize("integrator", ["euler", "rk4", "implicit", "implicitfast"])
def test_same_start_gives_the_same_bits(task, integrator):
    def run():
        environment = tasks.load(task, start, integrator=integrator)
        rows = []
        for _ in range(2):  # a second episode of one environment, too
            rows.append([environment.reset().observation["R"]])
            for command in commands:
                rows[-1].append(environment.step(command).observation["R"])
        return np.array(rows)

    start = tasks.start_set("tumbling", 3, arm=task.arm)[2]
    size = tasks.load(task).action_spec().shape
    commands = np.random.default_rng(3).normal(scale=20.0, size=(30, *size))
    first, second = run(), run()
    assert np.array_equal(first, second)
    assert np.array_equal(first[0], first[1])


@pytest.mark.parametrize("number", [0.0, -1e-3, math.nan, math.inf])
@pytest.mark.parametrize(("name", "usual"), [("dt", "1e-3"), ("horizon", "20.0")])
def test_impossible_dt_or_horizon_is_refused(task, name, usual, number):
    with pytest.raises(ValueError, match=rf"{name} = .* \(try: {name}={usual}\)"):
        tasks.load(task, **{name: number})


@pytest.mark.parametrize("quat", [(2.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), (math.nan, 0.0, 0.0, 0.0), (1.0, 0.0)])
def test_start_without_a_unit_quaternion_or_a_finite_velocity_is_refused(task, quat):
    for start in (Start("odd", quat), Start("odd", (1.0, 0.0, 0.0, 0.0), goal_wxyz=quat)):
        with pytest.raises(ValueError, match=r"start 'odd': .*unit quaternion"):
            tasks.load(task, start)
    with pytest.raises(ValueError, match=r"start 'odd': omega = .*finite"):
        tasks.load(task, Start("odd", (1.0, 0.0, 0.0, 0.0), omega=(0.0, math.nan, 0.0)))
