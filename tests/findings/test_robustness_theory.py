"""Closed forms of loops under delay, noise, a slow clock, a bound and moving goals, against what they solve."""

import cmath
import math

import numpy as np
import pytest

from bench.findings.theory import robustness_theory, thresholds
from bench.law.display import Equation
from tasks.condition import NO_FEEDFORWARD, RATE, RATE_AND_ACCELERATION
from tasks.rules import RULES

KP, KV, TOLERANCE = 100.0, 20.0, RULES.tolerance


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
