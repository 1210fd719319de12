"""The judge at work: settling and every outcome from first principles, its rules' numbers, and why an arm failed."""

import itertools
import math

import numpy as np
import pytest
from support.arm_paths import turned_in_place
from support.driving import ARM_METRICS, settings
from support.on_arms import named

import tasks
from bench.engines.simulate_arms import run_arm as run
from bench.experiments.episode_rows import frame
from bench.experiments.experiment import Unit
from bench.experiments.request import Request
from bench.experiments.suites import NOMINAL
from tasks import verdict as judge
from tasks.cause import CAUSES, NEAR_CONDITION, NEAR_MARGIN, cause
from tasks.kinematics import kinematics, rotation_vector
from tasks.rules import RULES, ticks
from tasks.verdict import (
    CREEPING,
    DIVERGED,
    GOING,
    OSCILLATING,
    OUTCOMES,
    SATURATED,
    SETTLED,
    SINGULAR,
    STUCK,
    TIMED_OUT,
    check_command,
    check_state,
    first_watch,
    watched,
)

BAND = RULES.band_haversine(1.0)
COMMAND = RULES.command_limit**2
SPEED = RULES.speed_limit**2
REST = RULES.hold_ticks(1e-3)
SLOW = RULES.band_rad(1.0) / RULES.hold_s


def watch_over(angles, speeds=None):
    """The watch after lists of angles [rad] and speeds [rad/s], the first at tick 0; at rest if none are given."""
    watch = None
    for tick, (angle, speed) in enumerate(zip(angles, speeds or [0.0] * len(angles), strict=True)):
        seen = (math.sin(angle / 2) ** 2, BAND, speed**2, RULES.slow_squared)
        watch = watched(watch, tick, *seen) if watch else first_watch(*seen)
    return watch


def verdict(angles, speeds=None, failure=GOING, speed=0.0, command=0.0):
    """The word after these; speed and command are those at the end that tell a stuck body."""
    watch, rest = watch_over(angles, speeds), (RULES.rest_speed**2, RULES.rest_command**2)
    return judge.verdict(failure, watch, len(angles) - 1, REST, speed**2, command**2, *rest)


def test_every_word_has_its_code():
    assert [getattr(judge, word.upper().replace("-", "_")) for word in OUTCOMES] == list(range(len(OUTCOMES)))


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
    assert (watch.settled_since, watch.entries > 0) == (since, entered)


def test_quiet_counts_ticks_under_a_hundredth_of_the_band():
    assert watch_over([1.0, 1.9e-4, 1.9e-4, 1.9e-4]).quiet == 3
    assert watch_over([1.0, 1.9e-4, 2.1e-4, 1.9e-4]).quiet == 1


@pytest.mark.parametrize(
    ("check", "limit", "beyond", "endless"),
    [(check_command, COMMAND, SATURATED, SINGULAR), (check_state, SPEED, *[DIVERGED] * 2)],
)
def test_command_or_state_is_taken_up_to_its_limit(check, limit, beyond, endless):
    found = [check(squared, limit) for squared in (0.0, limit, 1.01 * limit, math.nan, math.inf)]
    assert found == [GOING, GOING, beyond, endless, endless]


def test_slow_is_what_crosses_half_the_band_in_the_hold_window_or_longer():
    inside = [0.01] * 3
    assert watch_over(inside, [0.0, 0.999 * SLOW, 0.0]).rest == 3
    assert watch_over(inside, [0.0, 1.001 * SLOW, 0.0]).rest == 1


INSIDE, OUTSIDE, FAST = [0.01] * REST, [1.0] * REST, [1.0] * REST


@pytest.mark.parametrize(
    ("found", "given"),
    [
        (SINGULAR, {"angles": INSIDE, "failure": SINGULAR}),  # wherever the angle is
        (SETTLED, {"angles": [1.0, *INSIDE], "speed": 1.0, "command": 1.0}),
        (SETTLED, {"angles": [1.0, 0.01, 1.0, *INSIDE]}),  # an overshoot is none of it
        (CREEPING, {"angles": [1.0, *INSIDE[1:]]}),  # only just inside
        (STUCK, {"angles": OUTSIDE}),
        (CREEPING, {"angles": OUTSIDE, "speed": 0.01}),
        (CREEPING, {"angles": OUTSIDE, "command": 1.0}),
        (TIMED_OUT, {"angles": OUTSIDE, "speeds": FAST, "speed": 1.0}),
        (TIMED_OUT, {"angles": [1.0, 0.01, 1.0], "speeds": [1.0] * 3, "speed": 1.0}),  # through the goal, once
        (OSCILLATING, {"angles": [1.0, 0.01, 1.0, 0.01], "speeds": [1.0] * 4}),
        (OSCILLATING, {"angles": [1.0, 0.01, 1.0, 0.01, 1.0], "command": 1.0}),  # at a turning point
        (OSCILLATING, {"angles": INSIDE, "speeds": FAST}),  # shakes inside the band
    ],
)
def test_verdict_is_by_failure_then_rest_then_what_else_it_does(found, given):
    assert OUTCOMES[verdict(**given)] == OUTCOMES[found]


@pytest.mark.parametrize("frequency", [3.0, 10.0, 100.0])
@pytest.mark.parametrize("phase", [0.0, 0.5, 1.0, 1.5])
def test_undamped_oscillator_never_settles_wherever_the_horizon_cuts_it(frequency, phase):
    times = [1e-3 * k for k in range(round((20.0 + phase / frequency) * 1e3))]
    angles = [abs(math.cos(frequency * t)) for t in times]
    speeds = [frequency * math.sin(frequency * t) for t in times]
    ending = {"speed": speeds[-1], "command": frequency**2 * angles[-1]}
    assert verdict(angles, speeds, **ending) == OSCILLATING


PAPER_KP, PAPER_KV = 100.0, 20.0


def test_numbers_of_the_rules_are_what_they_are_said_to_be():
    assert RULES.band_rad(0.0) == RULES.band_rad(0.5 * RULES.at_goal_rad) == RULES.floor_rad
    assert RULES.band_haversine(2.0) == pytest.approx((1 - math.cos(0.04)) / 2, rel=1e-12)
    assert math.cos(RULES.tolerance * RULES.at_goal_rad) < 1.0  # visible in the matrix's diagonal
    assert RULES.rest_speed * 20.0 <= RULES.floor_rad
    assert RULES.rest_command == pytest.approx(RULES.rest_speed * math.sqrt(PAPER_KP))
    assert 100 * (PAPER_KP * math.sqrt(3) * math.pi + PAPER_KV * 20.0) < RULES.command_limit


@pytest.mark.parametrize(
    ("seconds", "dt", "expected"), [(20.0, 1e-3, 20000), (0.3, 0.1, 3), (1.1, 0.1, 11), (1e-4, 1e-3, 1)]
)
def test_ticks_are_the_nearest_whole_number(seconds, dt, expected):
    assert ticks(seconds, dt) == expected


FAILED = [word for word in OUTCOMES if word not in ("settled", "crashed", "hung")]
FAR, NEAR = (1.0, 5.0), (0.5 * NEAR_MARGIN, 2.0 * NEAR_CONDITION)


@pytest.mark.parametrize(("outcome", "word"), [("settled", ""), ("crashed", "law"), ("hung", "law")])
def test_settled_episode_has_no_cause_and_the_law_is_it_when_it_crashes_or_hangs(outcome, word):
    every = itertools.product([*FAR, *NEAR, 0.0, math.nan], [*FAR, *NEAR, math.inf, math.nan])
    assert {cause(outcome, margin, condition) for margin, condition in every} == {word}


@pytest.mark.parametrize("outcome", FAILED)
@pytest.mark.parametrize(
    ("margin", "condition", "word"),
    [
        (NEAR[0], NEAR[1], "both"),
        (NEAR[0], FAR[1], "representation"),
        (FAR[0], NEAR[1], "kinematic"),
        (math.nan, NEAR[1], "kinematic"),  # a law on R has no margin
        (0.0, FAR[1], "representation"),
        (FAR[0], math.inf, "kinematic"),
        (FAR[0], math.nan, "kinematic"),  # joint angles that are no numbers have no condition
        (math.nan, math.inf, "kinematic"),
        (0.0, math.inf, "both"),
    ],
)
def test_singularity_that_was_near_is_the_cause_however_it_failed(outcome, margin, condition, word):
    assert cause(outcome, margin, condition) == word


@pytest.mark.parametrize("margin", [FAR[0], math.nan])
def test_torque_is_the_cause_only_if_the_torque_rule_ended_it(margin):
    found = {outcome: cause(outcome, margin, FAR[1]) for outcome in FAILED}
    assert {outcome for outcome, word in found.items() if word == "torque"} == {"saturated", "singular"}
    assert set(found.values()) == {"torque", "law"} < set(CAUSES)
    assert cause("stuck", NEAR_MARGIN, NEAR_CONDITION) == "law"  # at the thresholds themselves nothing is near


ARM = "ur5e"


def rows_of(word: str, starts, horizon_s: float = 3.0, engine: str = "native"):
    """The rows that a run would store."""
    one = named(ARM, word)
    unit = Unit("arm", one.name, "arm-regulation", ARM, engine, "clear", NOMINAL, horizon_s=horizon_s)
    numbers = run(engine, one, unit.task, ARM, starts, settings(horizon_s=horizon_s), ARM_METRICS)
    return frame(Request(), unit, starts, numbers)


def test_condition_of_a_row_is_the_judges_largest_along_the_way():
    """At rest at its goal an arm stays; the largest is then that of the start, by numpy on MuJoCo's Jacobian."""
    model = kinematics(tasks.arm(ARM))
    start = model.start("home", model.arm.home, model.pose(model.arm.home)[1])
    [seen] = rows_of("rotation-matrix@geometric+solve", [start], 0.05, "reference").cond_jacobian_max
    assert seen == pytest.approx(np.linalg.cond(model.jacobian(model.arm.home)), rel=1e-6)


@pytest.mark.slow
def test_dead_point_of_the_law_is_the_laws_own_fault():
    starts = [one for one in tasks.start_set("half-turn", arm=ARM) if one.id.endswith("exact")]
    rows = rows_of("rotation-matrix@geometric+solve", starts, 1.0)
    stuck = rows[rows.outcome == "stuck"]
    assert len(stuck)
    assert set(stuck.cause) == {"law"}


def test_stretched_arm_fails_of_its_kinematics():
    model = kinematics(tasks.arm(ARM))
    start = model.start("straight", [0.0] * 6, model.pose(model.arm.home)[1])
    [row] = rows_of("rotation-matrix@geometric+dynamically-consistent", [start], engine="reference").itertuples()
    assert (row.outcome, row.cause) == ("singular", "kinematic")
    assert row.cond_jacobian_max > 1e8


@pytest.mark.slow
def test_pole_is_the_representations_fault_where_the_arm_is_well_conditioned():
    """From the middle of the turns of `pole`, the pole itself, on to their goals."""
    model, starts = kinematics(tasks.arm(ARM)), []
    for start in (one for one in tasks.start_set("pole", arm=ARM) if one.id.endswith("exact")):
        turn = np.array(rotation_vector(start.goal_wxyz, start.quat_wxyz))
        angle = float(np.linalg.norm(turn))
        q = turned_in_place(model, start.q, tuple(turn / angle), angle / 2.0, 40)[-1]
        starts.append(model.start(start.id, q, start.goal_wxyz))
    by_angles = rows_of("feedback-linearized/zyx-euler@analytic+solve", starts)
    failed = by_angles[by_angles.outcome != "settled"]
    assert len(failed)
    assert set(failed.cause) <= {"representation", "both"}  # thrown by the pole, the arm may come near its own
    by_matrix = rows_of("rotation-matrix@geometric+solve", starts)
    assert set(by_matrix.outcome) == {"settled"}
    assert set(by_matrix.cause) == {""}
