"""Both engines of contact record the same, bit for bit; dm_control's loop with the plain controller is the truth."""

import itertools

import numpy as np
import pytest
from support.bits import different_rows, same_bits
from support.in_contact import ARMS

import tasks
from bench.engines.contact_episode import FORCE, USUAL
from bench.engines.native.libmujoco import MUJOCO_INTEGRATORS
from bench.engines.simulate_contact import run_contact as run
from bench.law.control.registry import all_controllers, find_controller
from tasks.contact_model import STANDARD

TASKS = tasks.contact_names()
THREE = ("hybrid-base+inverse", "hybrid/zyx-euler+projected", "impedance-coordinates/zyx-euler")
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


# Every task with the first of the three, which presses as long as it lasts; each week with the others in turns.
@pytest.mark.parametrize(
    ("k", "word", "arm", "controller"),
    [
        pytest.param(k + c, word, ARMS[(k + c) % len(ARMS)], THREE[c], marks=pytest.mark.weekly if c else ())
        for k, word in enumerate(TASKS)
        for c in (0, 1 + k % 2)
    ],
)
def test_native_record_is_the_reference_record_bit_for_bit_to_the_horizon(k, word, arm, controller):
    task, on, trial = of(word, arm, k)
    fast, slow = both(controller, task, on, trial)
    assert_same(fast, slow)
    assert np.isfinite(slow.record).all()
    if task.touches(on) and controller == THREE[0]:
        felt = np.abs(slow.record[:, FORCE : FORCE + 3]).max(axis=1) > 0.0
        assert felt.sum() * USUAL.dt_s >= 2.0


BRIEFLY = [
    *((one.name, TASKS[k % len(TASKS)], k, USUAL) for k, one in enumerate(all_controllers())),
    *(
        (THREE[k % 3], word, k, USUAL._replace(integrator=integrator, dt_s=(1e-3, 5e-4)[k % 2]))
        for k, (word, integrator) in enumerate(zip(TASKS, itertools.cycle(MUJOCO_INTEGRATORS), strict=False))
    ),
]


@pytest.mark.parametrize(("controller", "word", "k", "conditions"), BRIEFLY)
def test_native_record_is_the_reference_record_of_every_controller_and_integrator(controller, word, k, conditions):
    task, arm, trial = of(word, ARMS[k % len(ARMS)], k)
    task = task._replace(horizon_s=0.2)
    fast, slow = both(controller, task, arm, trial, conditions)
    assert_same(fast, slow)


def with_memory(task, size: str):
    """The task with so little room for MuJoCo to work in."""

    def around(arm):
        made = task.surroundings(arm)
        return made._replace(others=f'{made.others}<size memory="{size}"/>')

    return task._replace(surroundings=around) if size else task


@pytest.mark.parametrize(
    ("arm", "word", "memory", "contact", "outcomes", "says", "ticks"),
    [
        (ARMS[0], "surface-alignment", "2K", STANDARD, ["broken"], "out of memory", range(1)),  # for collision
        (ARMS[-1], "force-on-plane", "2K", STANDARD, ["broken"], "out of memory", range(1, 100)),  # for a contact
        (ARMS[0], "crank", "1200", STANDARD, ["broken"], "mjWARN_CNSTRFULL", range(1001)),  # constraints are left out
        (
            *(ARMS[-1], "surface-alignment", "", STANDARD._replace(stiffness=1e12, damping=1e9)),
            *(["diverged", "saturated"], "", range(1, 1000)),
        ),
    ],
)
def test_episode_that_breaks_off_does_so_in_both_engines_alike(word, memory, contact, outcomes, says, ticks, arm):
    task, on, trial = of(word, arm, 0)
    task = with_memory(task._replace(horizon_s=1.0), memory)
    fast, slow = both(THREE[0], task, on, trial, USUAL, contact)
    assert_same(fast, slow)
    assert fast.outcome in outcomes
    assert says in fast.message
    assert len(fast.record) in ticks


def test_episode_is_the_same_whatever_ran_before_it():
    task, arm, trial = of("surface-alignment", ARMS[0], 0)
    short, controller = task._replace(horizon_s=0.3), find_controller(THREE[0])
    x, y, z = trial.scene_pos
    inside = trial._replace(id="inside the plate", scene_pos=(x, y, z + 0.3))
    alone = next(run("native", controller, short, arm, [trial]))
    rough, after = run("native", controller, short, arm, [inside, trial])
    assert same_bits(after.record, alone.record)
    assert not same_bits(rough.record, alone.record)
