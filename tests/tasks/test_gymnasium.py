"""The tasks as environments of Gymnasium, held against its own checker, MuJoCo and SciPy."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from scipy.spatial.transform import Rotation

import tasks
from tasks.gymnasium_suite import IDENTIFIERS

SURFACE = "orientation/SurfaceAlignment-v0"


@pytest.mark.parametrize("identifier", IDENTIFIERS)
def test_every_environment_passes_the_checker_of_gymnasium(identifier):
    check_env(gymnasium.make(identifier, render_mode="rgb_array").unwrapped)


def test_every_space_is_finite_and_what_is_seen_lies_in_it():
    for identifier in IDENTIFIERS:
        environment = gymnasium.make(identifier)
        seen, _ = environment.reset(seed=3)
        assert environment.observation_space.contains(seen)
        for box in environment.observation_space.values():
            assert np.isfinite(box.low).all()
            assert np.isfinite(box.high).all()
        assert (environment.observation_space["R"].high < 1.0 + 1e-6).all()


@pytest.mark.parametrize(
    ("identifier", "given", "steps"),
    [
        ("orientation/FreeBody-v0", {}, 20_000),
        ("orientation/FreeBody-v0", {"dt": 0.01, "time_limit": 30.0}, 3_000),
        ("orientation/WrenchProbe-v0", {}, 500),
        ("orientation/WrenchProbe-v0", {"time_limit": 0.1}, 100),
    ],
)
def test_spec_has_the_steps_of_the_time_limit(identifier, given, steps):
    environment = gymnasium.make(identifier, **given)
    assert environment.spec.max_episode_steps == steps
    again = gymnasium.make(environment.spec)
    assert again.spec.max_episode_steps == steps
    if steps <= 500:
        environment.reset(seed=0)
        still = np.zeros(environment.action_space.shape)
        ends = [environment.step(still)[3] for _ in range(steps)]
        assert ends.index(True) == steps - 1


def test_a_seed_repeats_the_starts_and_another_draws_others():
    environment = gymnasium.make("orientation/FreeBody-v0")
    drawn = [[environment.reset(seed=seed)[1]["start"], environment.reset()[1]["start"]] for seed in (1, 2, 1)]
    assert drawn[0] == drawn[2]
    assert len({*drawn[0], *drawn[1]}) == 4
    wanted = tasks.start_set("half-turn")[3]
    observation, info = environment.reset(options={"start": wanted})
    assert info["start"] == wanted.id
    np.testing.assert_allclose(observation["goal_quat"], wanted.goal_wxyz)


def test_many_at_once_are_as_one_alone():
    many = gymnasium.make_vec("orientation/ArmRegulation-v0", num_envs=2, arm="panda")
    alone = gymnasium.make("orientation/ArmRegulation-v0", arm="panda")
    together, _ = many.reset(seed=[5, 6])
    actions = np.full((2, 7), 0.01)
    stepped, rewards, *_ = many.step(actions)
    for place, seed in enumerate((5, 6)):
        observation, _ = alone.reset(seed=seed)
        np.testing.assert_array_equal(together["R"][place], observation["R"])
        observation, reward, *_ = alone.step(actions[place])
        np.testing.assert_array_equal(stepped["q"][place], observation["q"])
        assert rewards[place] == reward == pytest.approx(-rotation_from_goal(observation).magnitude(), abs=1e-12)


def rotation_from_goal(observation) -> Rotation:
    """R R_d^T by SciPy."""
    R, goal = observation["R"].reshape(3, 3).T, Rotation.from_quat(observation["goal_quat"], scalar_first=True)
    return Rotation.from_matrix(R) * goal.inv()


def test_reward_in_contact_is_the_error_of_what_is_specified():
    environment = gymnasium.make(SURFACE)
    environment.reset(seed=0)
    rewards = []
    for _ in range(400):
        seen, reward, *_ = environment.step(environment.action_space.sample() * 0.02)
        rewards.append(reward)
    away = 1000.0 * np.hstack((seen["p"] - seen["goal_p"], 0.1 * rotation_from_goal(seen).as_rotvec()))
    wrench = (seen["F"] + seen["desired_wrench"]) / np.repeat((1.0, 0.1), 3)
    held = seen["selection"] == 1.0
    assert reward == pytest.approx(-np.hypot(np.linalg.norm(away[held]), np.linalg.norm(wrench[~held])), rel=1e-9)
    assert len(set(rewards)) > 300


def test_diverged_simulation_terminates_and_a_time_limit_truncates():
    environment = gymnasium.make("orientation/ArmRegulation-v0", arm="panda", dt=0.01)
    environment.reset(seed=0)
    ends = [environment.step(np.ones(7))[2:] for _ in range(100)]
    end = next(end for end in ends if any(end[:2]))
    assert end[0]
    assert "diverged" in end[2]
    short = gymnasium.make(SURFACE, time_limit=0.003)
    short.reset(seed=0)
    assert [short.step(np.zeros(6))[3] for _ in range(3)] == [False, False, True]
