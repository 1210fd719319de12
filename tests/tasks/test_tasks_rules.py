"""The numbers of the rules, and that their stated derivations hold."""

import math

import pytest

from tasks.rules import RULES, ticks

PAPER_KP, PAPER_KV = 100.0, 20.0


def test_band_is_the_floor_when_start_is_at_goal():
    assert RULES.band_rad(0.0) == RULES.floor_rad
    assert RULES.band_rad(0.5 * RULES.at_goal_rad) == RULES.floor_rad


def test_band_haversine_is_that_of_the_band():
    assert RULES.band_haversine(2.0) == pytest.approx((1 - math.cos(0.04)) / 2, rel=1e-12)


def test_smallest_band_is_visible_in_the_matrix_diagonal():
    assert math.cos(RULES.tolerance * RULES.at_goal_rad) < 1.0
    assert math.cos(2**-27) == 1.0


def test_rest_speed_moves_a_body_no_further_than_the_floor():
    assert RULES.rest_speed * 20.0 <= RULES.floor_rad


def test_rest_command_belongs_to_the_rest_speed():
    assert RULES.rest_command == pytest.approx(RULES.rest_speed * math.sqrt(PAPER_KP))


def test_command_limit_is_far_above_the_paper_at_any_start():
    largest = PAPER_KP * math.sqrt(3) * math.pi + PAPER_KV * 20.0
    assert 100 * largest < RULES.command_limit


@pytest.mark.parametrize(
    ("seconds", "dt", "expected"), [(20.0, 1e-3, 20000), (0.3, 0.1, 3), (1.1, 0.1, 11), (1e-4, 1e-3, 1)]
)
def test_ticks_are_the_nearest_whole_number(seconds, dt, expected):
    assert ticks(seconds, dt) == expected
