"""The rule of rest in contact: what moves or turns by more than the bounds in the window is not at rest."""

import math

import pytest

from bench.law.so3 import from_quaternion
from tasks.contact_rest import REST, has_left, rest_numbers
from tasks.rotations import about

RULE = rest_numbers(True, 0.5, 1e-3)
STILL = from_quaternion((1.0, 0.0, 0.0, 0.0))
HERE = (0.3, -0.2, 0.4)
WINDOW = REST.hold_s


def turned(angle: float):
    return from_quaternion(about((0.6, 0.0, 0.8), angle))


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize(("share", "leaves"), [(0.99, False), (1.01, True), (-1.01, True)])
def test_hand_leaves_where_it_rests_by_the_distance_its_slowest_speed_takes_it(axis, share, leaves):
    p = [*HERE]
    p[axis] += share * REST.speed * WINDOW
    assert has_left(RULE, 600, tuple(p), STILL, HERE, STILL) is leaves


@pytest.mark.parametrize(("share", "leaves"), [(0.99, False), (1.01, True), (-1.01, True)])
def test_hand_leaves_where_it_rests_by_the_angle_its_slowest_rate_turns_it(share, leaves):
    assert has_left(RULE, 600, HERE, turned(share * REST.rate * WINDOW), HERE, STILL) is leaves


def test_rest_does_not_count_while_the_place_moves():
    assert has_left(RULE, RULE.first - 1, HERE, STILL, HERE, STILL)
    assert not has_left(RULE, RULE.first, HERE, STILL, HERE, STILL)
    assert RULE.first == 500


def test_task_without_an_end_is_never_over():
    assert rest_numbers(False, 0.5, 1e-3).ticks == 0


def test_rest_at_another_control_period_is_the_same_motion():
    other = rest_numbers(True, 0.5, 5e-4)
    assert other.ticks == 2 * RULE.ticks
    assert other[2:] == RULE[2:]
    assert math.isclose(RULE.turned_squared, 2.0 * (REST.rate * WINDOW) ** 2)
