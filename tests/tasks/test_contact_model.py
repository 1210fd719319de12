"""Contacts are as stiff as is stated, on every arm: a tip that presses at rest, by MuJoCo's force and depth."""

import pytest
from support.in_contact import ARMS

import tasks
from bench.engines.contact_episode import FORCE, GAP
from bench.engines.simulate_contact import run_contact as run
from bench.law.control.registry import find_controller
from tasks.contact_model import STANDARD

PRESSING = find_controller("hybrid-base+inverse")


def pressed(arm: str, stiffness: float, **more):
    """The episode of a tip that presses on a level plane with 15 N until it is at rest."""
    task, on = tasks.contact_task("force-on-plane")._replace(rests=True, horizon_s=4.0), tasks.arm(arm)
    trial = task.trials(on)[0]
    still = trial._replace(specification=trial.specification._replace(velocity=(0.0, 0.0, 0.0), moves_s=0.0))
    contact = STANDARD._replace(stiffness=stiffness, damping=0.02 * stiffness, **more)
    return next(run("native", PRESSING, task, on, [still], contact=contact))


EVENLY = {"dmin": 0.5, "dmax": 0.5}


@pytest.mark.parametrize("arm", ARMS)
@pytest.mark.parametrize(("stiffness", "more"), [(2e4, {}), (2e5, {}), (2e5, EVENLY)])
def test_force_over_depth_at_rest_is_the_stiffness_stated(arm, stiffness, more):
    """To what damping adds at the speed at which friction, not dry here, lets the tip creep: 1e-4 m/s along the plane,
    less than a tenth of it into it."""
    force, depth = of_end(pressed(arm, stiffness, noslip=0, **more))
    assert force / depth == pytest.approx(stiffness, rel=0.02 * stiffness * 1e-5 / force)


@pytest.mark.parametrize("arm", ARMS)
def test_dry_friction_leaves_the_stiffness_to_two_per_cent(arm):
    """MuJoCo's second solver changes friction and not the normal force, which had been found for another friction."""
    ended = pressed(arm, STANDARD.stiffness)
    force, depth = of_end(ended)
    assert ended.rested
    assert force == pytest.approx(15.0, rel=1e-4)
    assert force / depth == pytest.approx(STANDARD.stiffness, rel=0.02)


def of_end(ended) -> tuple[float, float]:
    """Force [N] and depth [m] at the end."""
    return float(ended.record[-1, FORCE + 2]), -float(ended.record[-1, GAP])
