"""Contacts are as stiff as they are said to be, on every arm: a tip that presses at rest, by MuJoCo's force and depth."""

import pytest
from support.in_contact import ARMS

import tasks
from bench.control.registry import find_controller
from bench.engines.contact_episode import FORCE, GAP
from bench.engines.run_contact import run
from tasks.contact_model import STANDARD
from tasks.contact_rest import REST

PRESSING = find_controller("hybrid-base+inverse")


def pressed(arm: str, stiffness: float, **more):
    """The episode of a tip that presses on a level plane with 15 N until it is at rest."""
    task, on = tasks.contact_task("force-on-plane")._replace(rests=True, horizon_s=4.0), tasks.arm(arm)
    trial = task.trials(on)[0]
    still = trial._replace(specification=trial.specification._replace(velocity=(0.0, 0.0, 0.0), moves_s=0.0))
    contact = STANDARD._replace(stiffness=stiffness, damping=0.02 * stiffness, **more)
    return next(run("native", PRESSING, task, on, [still], contact=contact))


@pytest.mark.parametrize("arm", ARMS)
@pytest.mark.parametrize(("stiffness", "more"), [(2e4, {}), (2e5, {}), (2e5, {"dmin": 0.5, "dmax": 0.5})])
def test_force_over_depth_at_rest_is_the_stiffness_stated(arm, stiffness, more):
    """To what a shiver of the bounds of rest may leave of the damping's force: damping * speed over the force."""
    ended = pressed(arm, stiffness, **more)
    assert ended.rested
    force, depth = ended.record[-1, FORCE + 2], -ended.record[-1, GAP]
    assert force / depth == pytest.approx(stiffness, rel=0.02 * stiffness * REST.speed / force + 1e-4)
    assert force == pytest.approx(15.0, rel=0.01)
