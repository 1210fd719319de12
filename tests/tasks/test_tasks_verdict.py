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


@pytest.mark.parametrize(
    ("angles", "since", "entered"),
    [
        ([1.0, 0.5, 0.019, 0.01], 2, True),  # the first tick inside for good
        ([1.0, 0.01, 0.03, 0.019, 0.01], 3, True),  # again, when the band is left
        ([1.0, 0.5, 0.03], 3, False),  # later than the last tick, when still outside
    ],
)
def test_settled_since_is_the_tick_after_the_last_one_outside(angles, since, entered):
    watch = watch_over(angles)
    assert (watch.settled_since, watch.entered) == (since, entered)


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


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ({"failure": SINGULAR, "inside": True}, SINGULAR),  # wherever the angle is
        ({"inside": True, "speed": 1.0, "command": 1.0}, SETTLED),
        ({}, STUCK),  # outside and at rest
        ({"speed": 0.01}, TIMED_OUT),  # outside and moving
        ({"command": 1.0}, TIMED_OUT),
    ],
)
def test_verdict_is_by_failure_then_angle_then_rest(given, found):
    assert ending(**given) == found
