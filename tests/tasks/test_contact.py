"""Contacts are as stiff as is stated, on every arm; and the rule of rest in contact."""

import math

import numpy as np
import pytest
from support.in_contact import ARMS

import tasks
from bench.engines.contact_episode import FORCE, GAP
from bench.engines.simulate_contact import run_contact as run
from bench.law.control.registry import find_controller
from bench.law.so3 import from_quaternion
from tasks.contact_model import STANDARD
from tasks.contact_rest import REST, has_left, rest_numbers
from tasks.rotations import about

RULE = rest_numbers(True, 0.5, 1e-3)
STILL = from_quaternion((1.0, 0.0, 0.0, 0.0))
HERE = (0.3, -0.2, 0.4)
WINDOW = REST.hold_s


@pytest.mark.parametrize(("share", "leaves"), [(0.99, False), (1.01, True), (-1.01, True)])
def test_hand_leaves_where_it_rests_by_what_its_slowest_speed_or_rate_takes_it(share, leaves):
    for away in np.eye(3) * share * REST.speed * WINDOW:
        assert has_left(RULE, 600, tuple(HERE + away), STILL, HERE, STILL) is leaves
    turned = from_quaternion(about((0.6, 0.0, 0.8), share * REST.rate * WINDOW))
    assert has_left(RULE, 600, HERE, turned, HERE, STILL) is leaves


def test_rest_does_not_count_while_the_place_moves():
    assert has_left(RULE, RULE.first - 1, HERE, STILL, HERE, STILL)
    assert not has_left(RULE, RULE.first, HERE, STILL, HERE, STILL)
    assert RULE.first == 500


def test_rest_at_another_control_period_is_the_same_motion_and_a_task_without_an_end_is_never_over():
    assert rest_numbers(False, 0.5, 1e-3).ticks == 0
    other = rest_numbers(True, 0.5, 5e-4)
    assert other.ticks == 2 * RULE.ticks
    assert other[2:] == RULE[2:]
    assert math.isclose(RULE.turned_squared, 2.0 * (REST.rate * WINDOW) ** 2)


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
