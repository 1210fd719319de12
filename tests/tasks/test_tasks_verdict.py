"""The judge at work: settling, early stop and every outcome, from first principles on short sequences."""

import math

import pytest

from tasks.rules import RULES
from tasks.verdict import (
    CRASHED,
    DIVERGED,
    GOING,
    HUNG,
    OUTCOMES,
    SATURATED,
    SETTLED,
    SINGULAR,
    STUCK,
    TIMED_OUT,
    check_command,
    check_state,
    first_watch,
    verdict,
    watched,
)

BAND = RULES.band_haversine(1.0)
COMMAND = RULES.command_limit**2
SPEED = RULES.speed_limit**2


def watch_over(angles):
    """The watch after a list of angles [rad], the first at tick 0."""
    haversines = [math.sin(angle / 2) ** 2 for angle in angles]
    watch = first_watch(haversines[0], BAND)
    for tick, haversine in enumerate(haversines[1:], start=1):
        watch = watched(watch, tick, haversine, BAND)
    return watch


def ending(failure=GOING, inside=False, speed=0.0, command=0.0):
    return verdict(failure, inside, speed**2, command**2, RULES.rest_speed**2, RULES.rest_command**2)


def test_codes_are_the_places_of_the_words():
    codes = (SETTLED, STUCK, TIMED_OUT, DIVERGED, SINGULAR, SATURATED, CRASHED, HUNG)
    assert [OUTCOMES[code] for code in codes] == [
        "settled",
        "stuck",
        "timed-out",
        "diverged",
        "singular",
        "saturated",
        "crashed",
        "hung",
    ]


def test_settled_since_is_the_first_tick_inside_for_good():
    assert watch_over([1.0, 0.5, 0.019, 0.01]).settled_since == 2


def test_settled_since_starts_again_when_the_band_is_left():
    watch = watch_over([1.0, 0.01, 0.03, 0.019, 0.01])
    assert watch.settled_since == 3
    assert watch.entered


def test_settled_since_is_later_than_the_last_tick_when_still_outside():
    watch = watch_over([1.0, 0.5, 0.03])
    assert watch.settled_since == 3
    assert not watch.entered


def test_quiet_counts_ticks_under_a_hundredth_of_the_band():
    assert watch_over([1.0, 1.9e-4, 1.9e-4, 1.9e-4]).quiet == 3
    assert watch_over([1.0, 1.9e-4, 2.1e-4, 1.9e-4]).quiet == 1


def test_command_is_applied_up_to_the_limit():
    assert check_command(0.0, COMMAND) == GOING
    assert check_command(COMMAND, COMMAND) == GOING
    assert check_command(1.01 * COMMAND, COMMAND) == SATURATED


@pytest.mark.parametrize("squared", [math.nan, math.inf])
def test_command_that_is_not_finite_is_singular(squared):
    assert check_command(squared, COMMAND) == SINGULAR


@pytest.mark.parametrize("squared", [1.01 * SPEED, math.nan, math.inf])
def test_state_beyond_the_limit_or_not_finite_has_diverged(squared):
    assert check_state(squared, SPEED) == DIVERGED
    assert check_state(SPEED, SPEED) == GOING


def test_failure_is_the_verdict_wherever_the_angle_is():
    assert ending(SINGULAR, inside=True) == SINGULAR


def test_inside_the_band_is_settled():
    assert ending(inside=True, speed=1.0, command=1.0) == SETTLED


def test_outside_and_at_rest_is_stuck():
    assert ending() == STUCK


@pytest.mark.parametrize("moving", [{"speed": 0.01}, {"command": 1.0}])
def test_outside_and_moving_is_timed_out(moving):
    assert ending(**moving) == TIMED_OUT
