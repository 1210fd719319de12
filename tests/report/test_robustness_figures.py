"""Closed forms of the pages on robustness, against what they solve; the pages themselves, from a small run."""

import cmath
import math

import numpy as np
import pytest
from support.pages import assert_is_whole

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

import tasks
from bench.cli.details import robustness as details
from bench.experiments import plan
from bench.experiments.choice import Choice
from bench.experiments.tables import read
from bench.findings import perturbed, why
from bench.findings.perturbed import Way
from bench.findings.theory import robustness_theory, thresholds
from bench.law.contenders.registry import find_contender
from bench.law.display import Equation
from bench.running import run
from report.figures.cards import regulators
from report.figures.kit.page import run_in
from report.figures.robustness import half_turn_noise, other_perturbations, robustness, rows, saturation
from tasks.condition import NO_FEEDFORWARD, RATE, RATE_AND_ACCELERATION, condition_at
from tasks.rules import RULES

KP, KV, TOLERANCE = 100.0, 20.0, RULES.tolerance
LAWS = ("rotation-vector", "paielli-bach", "hybrid", "quaternion-shortest", "quaternion-unwinding")
STARTS = 2


@pytest.mark.parametrize("kp", [20.0, KP, 3000.0])
def test_loop_of_the_delay_margin_is_on_the_edge_of_stability(kp):
    s = 1j * robustness_theory.crossover(kp, KV)
    delay = robustness_theory.delay_margin(kp, KV)
    assert (KV * s + kp) / s**2 * cmath.exp(-s * delay) == pytest.approx(-1.0, abs=1e-12)


@pytest.mark.parametrize("kp", [KP, 3000.0])
def test_sampled_loop_is_on_the_edge_of_stability_at_the_least_rate(kp):
    rate = robustness_theory.least_rate(kp, KV)
    for factor, is_stable in ((0.999, False), (1.001, True)):
        A, _ = robustness_theory.sampled(kp, KV, 1.0 / (factor * rate))
        assert (np.abs(np.linalg.eigvals(A)).max() < 1.0) == is_stable


@pytest.mark.parametrize(("attitude", "rate"), [(0.01, 0.0), (0.0, 0.3)])
def test_noise_leaves_what_a_drawn_sequence_leaves(attitude, rate):
    A, B = robustness_theory.sampled(KP, KV, 0.01)
    noise = np.random.default_rng(5).standard_normal((400, 2, 300)) * np.array([[attitude], [rate]])
    state, squares = np.zeros((2, 300)), []
    for drawn in noise:
        state = A @ state + B @ drawn
        squares.append(3.0 * (state[0] ** 2).mean())
    # the first 200 ticks are twenty time constants; of the rest some thousand values are independent: 2 % of the root
    expected = robustness_theory.noisy_rms(KP, KV, 0.01, attitude, rate)
    assert math.sqrt(np.mean(squares[200:])) == pytest.approx(expected, rel=0.05)


def test_jitter_is_the_mean_length_of_drawn_differences():
    noise = np.random.default_rng(7).standard_normal((100_000, 2, 3)) * np.array([[0.01], [0.1]])
    u = KP * noise[:, 0] + KV * noise[:, 1]
    assert np.linalg.norm(np.diff(u, axis=0), axis=1).mean() == pytest.approx(
        robustness_theory.jitter(KP, KV, 0.01, 0.1), rel=0.01
    )


def test_lag_behind_a_slow_goal_told_nothing_is_the_frequency_response():
    # both axes sway at peak rates of 1/sqrt(2), with 2 and 3.1 rad/s (tasks/moving_goal.py), five seconds from t = 0
    times = np.linspace(4.0, 5.0, 2000)
    squares = 0.0
    for rate in (2.0, 3.1):
        s = 1j * rate
        gain = (s**2 + KV * s) / (s**2 + KV * s + KP) / rate * math.sqrt(0.5)
        squares = squares + (gain * np.exp(s * times)).imag ** 2
    found = robustness_theory.tracking_rms(KP, KV, NO_FEEDFORWARD, 1e-3, 5.0)
    assert found == pytest.approx(math.sqrt(squares.mean()), rel=2e-3)


def test_each_thing_told_of_a_goal_makes_the_error_smaller():
    given = (NO_FEEDFORWARD, RATE, RATE_AND_ACCELERATION)
    errors = [robustness_theory.tracking_rms(KP, KV, one, 1e-3, 5.0) for one in given]
    assert errors[0] > 5.0 * errors[1] > 500.0 * errors[2]


def test_least_settling_time_is_reached_by_full_thrust_and_full_brakes():
    angle, bound = 2.0, 30.0
    turned = math.sqrt((1.0 + TOLERANCE) * angle / bound)
    left, speed = angle - 0.5 * bound * turned**2, bound * turned
    braking = robustness_theory.least_settling(angle, bound, TOLERANCE) - turned
    left, speed = left - speed * braking + 0.5 * bound * braking**2, speed - bound * braking
    assert left == pytest.approx(TOLERANCE * angle)  # enters the band, and stops at its far edge:
    assert left - 0.5 * speed**2 / bound == pytest.approx(-TOLERANCE * angle)


@pytest.mark.parametrize(("factor", "is_held"), [(0.99, False), (1.01, True)])
def test_noise_holds_a_law_of_constant_force_if_it_is_more_than_two_ticks_of_it(factor, is_held):
    """One tick of U makes the rate U h before the law can measure it; the next, of -U - Kv U h, takes it."""
    push, h = Equation("1", lambda theta: 1.0), robustness_theory.STEP_S
    two_ticks = KP * h * h * (1.0 - 0.5 * KV * h)
    assert robustness_theory.is_held(push, KP, KV, factor * two_ticks) == is_held


def test_law_whose_command_vanishes_at_the_half_turn_is_held_by_any_noise():
    assert thresholds.least("rotation-matrix", KP, KV) == 0.0


def test_memory_ends_where_its_hysteresis_does():
    # eta = cos(theta/2) at -delta; the trace at 0; |sigma| = tan(theta/4) at sqrt(switch)
    assert math.cos((math.pi + thresholds.keeps("hybrid")) / 2.0) == pytest.approx(-0.4)
    assert 1.0 + 2.0 * math.cos(math.pi + thresholds.keeps("late-braking")) == pytest.approx(0.0)
    assert math.tan((math.pi + thresholds.keeps("mrp-linearized")) / 4.0) ** 2 == pytest.approx(1.5)


@pytest.mark.parametrize("law", ["hybrid", "late-braking"])
def test_cards_of_laws_with_memory_say_how_far_they_keep_to_their_way(law):
    _, fails = regulators.text_of(half_turn_noise.regulator_of(law))
    assert f"{math.degrees(thresholds.keeps(law)):.0f} degrees" in fails


# ---------------------------------------------------------------------------------------------- pages, from a small run

PAGES = (robustness, half_turn_noise, saturation, other_perturbations)


@pytest.fixture(scope="module", autouse=True)
def small_run(tmp_path_factory):
    """Results with two starts a level of five laws; the pages read those of this module's folder."""
    choice = Choice(axes=robustness.AXES)
    made = plan.make("quick", [find_contender(law) for law in LAWS], choice, count=STARTS)
    folder = tmp_path_factory.mktemp("robustness") / "run"
    run.run(made, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(read.VARIABLE, str(folder))
        yield run_in(folder)


@pytest.fixture
def along(small_run):
    return lambda name: rows.along(small_run, name)


@pytest.mark.parametrize("page", PAGES, ids=lambda one: one.__name__.rpartition(".")[2])
def test_page_is_whole(page, small_run):
    assert_is_whole(page, small_run)


def step_linear_loop(period_s: float, delay_s: float, inertia: float) -> float:
    """Return the settling time [s] of the linear loop from rest: sampled, held, late, and with another inertia."""
    steps = max(1, math.ceil(period_s / robustness_theory.STEP_S - 1e-9))
    h = period_s / steps
    late, x, v, last, sent = round(delay_s / h), 1.0, 0.0, -1, []
    for tick in range(round(3.0 / h)):
        if tick % steps == 0:
            sent.append(-(KP * x + KV * v) / inertia)
        u = sent[(tick - late) // steps] if tick >= late else 0.0
        x, v = x + h * v + 0.5 * h * h * u, v + h * u
        if abs(x) > TOLERANCE:
            last = tick + 1
    return math.inf if last >= round(3.0 / h) else (last + 1) * h


@pytest.mark.parametrize("name", ["control-rate", "delay", "inertia"])
def test_rotation_vector_is_the_linear_loop_from_rest_at_every_level_and_angle(name, along):
    own = rows.of(along(name), "rotation-vector")
    for level, times in own.groupby("level")["time_s"]:
        at = condition_at(tasks.axis(name), level)
        theory = step_linear_loop(at.period_s, at.delay_s, at.inertia[0])
        assert times.to_numpy() == pytest.approx(theory, abs=1e-9)


def test_no_law_settles_sooner_than_the_bound_on_its_command_allows(small_run):
    assert saturation.bounded(small_run)["over_least"].min() >= 1.0


def test_theory_says_which_laws_the_worst_noise_holds_at_the_half_turn(small_run):
    found = half_turn_noise.facts(small_run)
    assert found["agree"] == found["decided"] > 0


def test_threshold_is_the_level_before_the_first_that_costs_a_law_its_starts(small_run):
    each, way = robustness.found(small_run), Way("half-turn-noise")
    assert (each["quaternion-shortest"][way].held, each["quaternion-shortest"][way].broken) == (0.0, 0.001)
    assert (each["hybrid"][way].held, each["hybrid"][way].broken) == (0.3, 1.0)
    assert math.isnan(each["paielli-bach"][way].held)


def test_judge_and_show_have_one_threshold(small_run):
    rows_of_run = small_run.rows("robustness")
    lines = details.summary(rows_of_run).set_index("law")
    for law, own in perturbed.thresholds(read.with_contender(perturbed.by_level(rows_of_run))).items():
        text = why.perturbed(rows_of_run[rows_of_run["contender"] == law])[0].text
        for way, one in own.items():
            assert lines.loc[law, way.name] == str(one)
            assert f"{way.name} {'none' if math.isnan(one.held) else f'{one.held:g}'}" in text


def test_moving_goals_break_every_law_where_theory_near_the_goal_says(small_run):
    for axis in ("moving-goal-rate", "moving-goal-untold"):
        limit = thresholds.near_goal(axis, True, KP, KV)
        for own in robustness.found(small_run).values():
            assert own[Way(axis)].held < limit < own[Way(axis)].broken
