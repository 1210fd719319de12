"""Closed forms of loops, against what they solve: held goals, delay, noise, a slow clock, a bound, the largest K dt."""

import cmath
import math

import numpy as np
import pandas as pd
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation as ScipyRotation
from support.driving import settings
from support.states import of_scipy

import tasks
from bench.engines.episode import OUTCOME
from bench.engines.simulate import run
from bench.experiments import plan
from bench.experiments.experiment import rows_of
from bench.experiments.request import Request
from bench.experiments.tables.run import with_contender
from bench.experiments.velocity_limits import LAG_TICKS
from bench.findings.theory import robustness_theory, thresholds
from bench.findings.theory.held_goals import held_share, least_cosine
from bench.findings.theory.velocity_limits import (
    by_eigenvalues,
    derivative,
    lagged,
    near,
    on_arm,
    with_theory,
)
from bench.law.contenders.registry import all_contenders, contenders, find_contender, inverse
from bench.law.display import Equation
from bench.law.inputs import AT_REST, Gains, Goal
from tasks.base import Start
from tasks.kinematics import kinematics
from tasks.moving_goal import NO_FEEDFORWARD, RATE, RATE_AND_ACCELERATION
from tasks.rotations import about, multiply
from tasks.rules import RULES
from tasks.verdict import SETTLED

LAW = find_contender("linearized-euler/zyx-euler")
PAPER = Gains()
BETAS = (-1.2, 0.0, 0.4, 1.0)


def compute_growth(goal: ScipyRotation, gains: Gains) -> float:
    """Return the largest real part of the eigenvalues of the closed loop about a goal, by central differences [1/s]."""
    system, goal_matrix, step = np.eye(6, k=3), of_scipy(goal), 1e-5
    for i, unit in enumerate(step * np.eye(3)):
        turned = [of_scipy(ScipyRotation.from_rotvec(sign * unit) * goal) for sign in (1, -1)]
        states = ((i, [(R, AT_REST) for R in turned]), (3 + i, [(goal_matrix, tuple(s * unit)) for s in (1, -1)]))
        for column, ends in states:
            up, down = (np.array(LAW.law(*end, Goal(goal_matrix), gains)) for end in ends)
            system[3:, column] = (up - down) / (2.0 * step)
    return float(np.linalg.eigvals(system).real.max())


def goal_beside(beta: float, gains: Gains, beyond_rad: float) -> ScipyRotation:
    """Return a goal with this beta whose alpha is so much beyond the closed form's boundary; gamma does not matter."""
    return ScipyRotation.from_euler("ZYX", (math.acos(least_cosine(beta, gains)) + beyond_rad, beta, 0.7))


@pytest.mark.parametrize("beta", BETAS)
@pytest.mark.parametrize("gains", [PAPER, Gains(100.0, 10.0), Gains(25.0, 30.0)])
def test_loop_about_a_goal_is_unstable_just_beyond_the_closed_forms_boundary(gains, beta):
    assert (
        compute_growth(goal_beside(beta, gains, -1e-5), gains)
        < 0.0
        < compute_growth(goal_beside(beta, gains, 1e-5), gains)
    )


def test_share_is_that_of_random_goals():
    """Angles by scipy; three standard errors of 20,000 goals."""
    angles = ScipyRotation.random(20_000, rng=np.random.default_rng(3)).as_euler("ZYX")
    held = np.cos(angles[:, 0]) > least_cosine(angles[:, 1], PAPER)
    assert held.mean() == pytest.approx(held_share(PAPER), abs=3.0 * math.sqrt(0.25 / 20_000))


@pytest.mark.parametrize(("beyond", "expected"), [(-0.05, True), (0.05, False)])
def test_body_beside_its_goal_stays_there_only_if_the_goal_is_held(beyond, expected):
    """A thousandth of a radian off; 0.05 rad past the boundary its error grows."""
    goals = [tuple(goal_beside(beta, PAPER, beyond).as_quat(scalar_first=True).tolist()) for beta in BETAS]
    starts = [Start("", multiply(about((0.48, -0.6, 0.64), 1e-3), goal), goal_wxyz=goal) for goal in goals]
    found = run("ideal-rk4", LAW, "free-body", starts, settings(horizon_s=20.0), ())
    assert [row[OUTCOME] == SETTLED for row in found] == [expected] * len(starts)


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


@pytest.mark.parametrize(("factor", "is_held"), [(0.99, False), (1.01, True)])
def test_noise_holds_a_law_of_constant_force_if_it_is_more_than_two_ticks_of_it(factor, is_held):
    """One tick of U makes the rate U h before the law can measure it; the next, of -U - Kv U h, takes it."""
    push, h = Equation("1", lambda theta: 1.0), robustness_theory.STEP_S
    two_ticks = KP * h * h * (1.0 - 0.5 * KV * h)
    assert robustness_theory.is_held(push, KP, KV, factor * two_ticks) == is_held


def test_law_whose_command_vanishes_at_the_half_turn_is_held_by_any_noise():
    assert thresholds.least("rotation-matrix", KP, KV) == 0.0


EXACT = ("solve", "pseudo-inverse", "truncated-svd", "damped-least-squares-variable")


def test_limit_of_every_velocity_law_is_within_one_percent_of_its_closed_form():
    laws = [one for one in all_contenders() if not one.regulator.costing_only]
    made = plan.make(Request("quick", tuple(laws), experiments=("velocity-limits",)))
    rows = with_theory(with_contender(pd.concat([rows_of(made.request, unit) for unit in made.units])))
    has_theory = rows["k_dt_theory"].notna()
    off = (rows["k_dt"] - rows["k_dt_theory"]).abs() - 0.01 * rows["k_dt_theory"]
    assert rows[has_theory & (off > 0.0)].to_dict("records") == []
    assert set(rows.loc[rows["reach"] == "near", "k_dt_theory"].isna()) == {False}


@pytest.mark.parametrize("lag", LAG_TICKS)
def test_limit_behind_servos_is_where_a_root_leaves_the_circle(lag):
    """Roots of the sampled loop by the exponential of its matrix, on both sides of the limit."""

    def largest_root(K):
        if lag == 0.0:
            return abs(1.0 - K)
        A = np.array([[0.0, -1.0, 0.0], [0.0, -1.0 / lag, 1.0 / lag], [0.0, 0.0, 0.0]])  # of (e, rate, command)
        step = expm(A)
        closed = step[:2, :2] + np.outer(step[:2, 2], (K, 0.0))
        return np.abs(np.linalg.eigvals(closed)).max()

    assert largest_root(0.999 * lagged(lag)) < 1.0 < largest_root(1.001 * lagged(lag))


@pytest.mark.parametrize("arm", tasks.arm_names())
def test_limit_of_exact_inverses_is_two_and_of_the_transpose_that_of_its_largest_singular_value(arm):
    q, joints = tasks.arm(arm).home, tasks.arm(arm).joints
    for word in EXACT:
        if not contenders("inverses")[word].refuses(6, joints):
            assert on_arm(arm, q, inverse(word)) == pytest.approx(2.0, rel=1e-6)
    largest = np.linalg.svd(kinematics(tasks.arm(arm)).jacobian(q), compute_uv=False)[0]
    assert on_arm(arm, q, inverse("transpose")) == pytest.approx(2.0 / largest**2, rel=1e-9)


def test_closed_form_of_a_law_with_an_equation_is_that_of_its_derivative():
    for one in all_contenders():
        if one.equation is not None and one.regulator.memory is None and not one.regulator.in_engine:
            assert by_eigenvalues(derivative(one)) == pytest.approx(near(one), rel=1e-4)


def test_limit_of_errors_that_turn_is_that_of_complex_roots():
    turning = np.array([[1.0, -1.0], [1.0, 1.0]])  # eigenvalues 1 +- i: |1 - k (1 + i)| = 1 at k = 1
    assert by_eigenvalues(turning) == pytest.approx(1.0)
    assert by_eigenvalues(-np.eye(3)) == 0.0
