"""Both engines of contact record the same, bit for bit; dm_control's loop with the plain controller is the truth."""

import functools

import numpy as np
import pytest
from support.bits import different_rows, same_bits
from support.in_contact import ARMS

import tasks
from bench.base.errors import BadNumber
from bench.engines.contact_episode import FORCE, USUAL, WIDTH, P, R, Sensor, sensed
from bench.engines.native.libmujoco import MUJOCO_INTEGRATORS
from bench.engines.simulate_contact import run_contact as run
from bench.law.control.registry import all_controllers, find_controller
from tasks.contact_model import STANDARD

TASKS = tasks.contact_names()
THREE = ("hybrid-base+inverse", "hybrid/zyx-euler+projected", "impedance-coordinates/zyx-euler")
# What J and the frame decide is the base's alone: these do not know how the hand's frame is drawn.
FRAMELESS = ("hybrid-base+inverse", "hybrid-base+transpose", "hybrid-hand+projected", "impedance-geometric")
ENGINES = ("native", "reference")


def of(word: str, arm: str, k: int):
    """A task, an arm, and one of the task's trials, another for each k."""
    task, on = tasks.contact_task(word), tasks.arm(arm)
    trials = task.trials(on)
    return task, on, trials[(5 * k + 2) % len(trials)]


def both(controller: str, task, arm, trial, *settings):
    """The episode of the compiled loop and of dm_control's."""
    return [next(run(engine, find_controller(controller), task, arm, [trial], *settings)) for engine in ENGINES]


def assert_same(fast, slow) -> None:
    """Records, bit for bit, and how they ended."""
    assert (fast.outcome, fast.message) == (slow.outcome, slow.message)
    assert different_rows(fast.record, slow.record) == []


# Every task with the first of the three, which presses as long as it lasts, and the other two in turns.
@pytest.mark.parametrize(
    ("k", "word", "arm", "controller"),
    [(k + c, word, ARMS[(k + c) % len(ARMS)], THREE[c]) for k, word in enumerate(TASKS) for c in (0, 1 + k % 2)],
)
def test_native_record_is_the_reference_record_bit_for_bit_to_the_horizon(k, word, arm, controller):
    task, on, trial = of(word, arm, k)
    fast, slow = both(controller, task, on, trial)
    assert_same(fast, slow)
    assert np.isfinite(slow.record).all()
    if task.touches(on) and controller == THREE[0]:
        felt = np.abs(slow.record[:, FORCE : FORCE + 3]).max(axis=1) > 0.0
        assert felt.sum() * USUAL.dt_s >= 2.0


@pytest.mark.parametrize(("k", "integrator"), list(enumerate(MUJOCO_INTEGRATORS)))
@pytest.mark.parametrize("word", TASKS)
def test_native_record_is_the_reference_record_with_every_integrator(k, word, integrator):
    task, arm, trial = of(word, ARMS[k % len(ARMS)], k)
    conditions = USUAL._replace(integrator=integrator, dt_s=(1e-3, 5e-4)[k % 2])
    assert_same(*both(THREE[k % 3], task._replace(horizon_s=0.2), arm, trial, conditions))


@pytest.mark.parametrize(("k", "controller"), list(enumerate(one.name for one in all_controllers())))
def test_native_record_is_the_reference_record_of_every_controller(k, controller):
    task, arm, trial = of(TASKS[k % len(TASKS)], ARMS[k % len(ARMS)], k)
    assert_same(*both(controller, task._replace(horizon_s=0.2), arm, trial))


LATE = Sensor(0.003, 0.5, 0.05, seed=4)


@pytest.mark.parametrize("controller", THREE)
def test_native_record_is_the_reference_record_with_a_late_and_noisy_sensor(controller):
    task, arm, trial = of("surface-alignment", ARMS[0], 1)
    short, late = task._replace(horizon_s=0.3), USUAL._replace(sensor=LATE)
    fast, slow = both(controller, short, arm, trial, late)
    assert_same(fast, slow)
    [exact, _] = both(controller, short, arm, trial)
    assert not same_bits(fast.record, exact.record)


def test_controller_is_given_the_wrench_of_some_ticks_ago_and_none_before():
    record, still = np.arange(10.0 * WIDTH).reshape(10, WIDTH), np.zeros((10, 6))
    now = (1.0, 2.0, 3.0), (4.0, 5.0, 6.0)
    assert sensed(*now, record, 7, 0, still) == now
    assert sensed(*now, record, 2, 3, still) == ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    f, m = sensed(*now, record, 7, 3, still)
    assert (*f, *m) == tuple(record[4, FORCE : FORCE + 6])
    noise = LATE.noise(1000)
    assert (np.array(sensed(*now, record, 7, 0, noise)) - np.array(now)).ravel() == pytest.approx(noise[7])
    assert noise.std(axis=0) == pytest.approx([0.5] * 3 + [0.05] * 3, rel=0.1)


@pytest.mark.parametrize("name", Sensor._fields[:3])
def test_sensor_that_is_none_is_refused(name):
    task, arm, trial = of("surface-alignment", ARMS[0], 1)
    with pytest.raises(BadNumber, match=f"sensor: {name} = -1"):
        both(THREE[0], task, arm, trial, USUAL._replace(sensor=Sensor(**{name: -1.0})))


def with_memory(task, size: str):
    """The task with so little room for MuJoCo to work in."""

    def around(arm):
        made = task.surroundings(arm)
        return made._replace(others=f'{made.others}<size memory="{size}"/>')

    return task._replace(surroundings=around)


@pytest.mark.parametrize("arm", ARMS)
@pytest.mark.parametrize(("word", "from_tick_0"), [("surface-alignment", True), ("force-on-plane", False)])
def test_error_of_MuJoCos_own_ends_an_episode_in_both_engines_alike(word, from_tick_0, arm):
    """At once, where collision needs the room; or when the first contact does."""
    task, on, trial = of(word, arm, 0)
    fast, slow = both(THREE[0], with_memory(task, "2K"), on, trial)
    assert_same(fast, slow)
    assert fast.outcome == "broken"
    assert "out of memory" in fast.message
    assert (len(fast.record) == 0) == from_tick_0
    assert len(fast.record) < 100


@pytest.mark.parametrize("arm", ARMS)
def test_constraints_that_MuJoCo_leaves_out_break_an_episode_in_both_engines_alike(arm):
    task, on, trial = of("crank", arm, 0)
    fast, slow = both(THREE[0], with_memory(task._replace(horizon_s=0.1), "1200"), on, trial)
    assert_same(fast, slow)
    assert (fast.outcome, fast.message) == ("broken", "mjWARN_CNSTRFULL")


@pytest.mark.parametrize("arm", ARMS)
def test_contact_that_explodes_is_an_outcome_in_both_engines_alike(arm):
    task, on, trial = of("surface-alignment", arm, 0)
    fast, slow = both(THREE[0], task, on, trial, USUAL, STANDARD._replace(stiffness=1e12, damping=1e9))
    assert_same(fast, slow)
    assert fast.outcome in ("diverged", "saturated")
    assert 0 < len(fast.record) < 1000


def test_episode_is_the_same_whatever_ran_before_it():
    task, arm, trial = of("surface-alignment", ARMS[0], 0)
    short, controller = task._replace(horizon_s=0.3), find_controller(THREE[0])
    x, y, z = trial.scene_pos
    inside = trial._replace(id="inside the plate", scene_pos=(x, y, z + 0.3))
    alone = next(run("native", controller, short, arm, [trial]))
    rough, after = run("native", controller, short, arm, [inside, trial])
    assert same_bits(after.record, alone.record)
    assert not same_bits(rough.record, alone.record)


@functools.cache
def alike(word: str, arm: str) -> tuple:
    """Groups of trials that differ in the hand's frame alone, of which there is more than one."""
    found = {}
    for trial in tasks.contact_task(word).trials(tasks.arm(arm)):
        found.setdefault(trial._replace(id="", pose="", goal_wxyz=(), mount_wxyz=()), []).append(trial)
    return tuple(group for group in found.values() if len(group) > 1)


@pytest.mark.parametrize("controller", FRAMELESS)
@pytest.mark.parametrize("arm", ARMS)
@pytest.mark.parametrize("word", TASKS)
def test_controller_along_the_bases_axes_does_not_see_how_the_hands_frame_is_drawn(word, arm, controller):
    """To rounding, which contact amplifies: measured 1e-15 m where nothing or one point touches, 1e-10 m at worst where
    a peg slides from one corner to another, on the Panda's light hand 5e-8 m. A micrometre is a tenth of what contacts
    give way at rest. Rest may be found a tick sooner."""
    task, on = tasks.contact_task(word), tasks.arm(arm)
    for group in alike(word, arm)[:2]:
        p, turn = [], []
        for ended in run("native", find_controller(controller), task, on, group):
            assert ended.outcome == "done"
            p.append(ended.record[:, P : P + 3])
            matrix = ended.record[:, R : R + 9].reshape(-1, 3, 3).transpose(0, 2, 1)
            turn.append(matrix @ matrix[0].T)
        lasts = min(map(len, p))
        assert max(map(len, p)) - lasts <= 1
        assert np.ptp([one[:lasts] for one in p], axis=0).max() <= 1e-6
        assert np.ptp([one[:lasts] for one in turn], axis=0).max() <= 1e-5


@pytest.mark.parametrize("arm", ARMS)
@pytest.mark.parametrize("word", ["surface-alignment", "peg-in-hole", "crank"])
def test_controller_along_euler_angles_does_see_it(word, arm):
    task, on = tasks.contact_task(word), tasks.arm(arm)
    trials = alike(word, arm)[1]
    p = [ended.record[-1, P : P + 3] for ended in run("native", find_controller(THREE[1]), task, on, trials)]
    assert np.ptp(p, axis=0).max() > 1e-4
