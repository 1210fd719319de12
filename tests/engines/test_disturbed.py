"""The perturbed free body: closed forms and recursions of one axis, scipy, and the engine without perturbations."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import same_bits
from support.bodies import path
from support.driving import METRICS, settings
from support.states import matrix, of_scipy

import tasks
from bench.engines import rigid_body
from bench.engines.binding import evaluation_of, memory_of, observer
from bench.engines.episode import FINAL_ANGLE, FIRST_METRIC, OUTCOME, SETTLING_TICK, TICKS, blank, numbers, start_rows
from bench.engines.plants import perturbed
from bench.engines.simulate import run as run_unperturbed
from bench.engines.simulate import simulate
from bench.engines.simulate_bodies import draw_noise
from bench.engines.simulate_bodies import run_disturbed as run
from bench.law.contenders.registry import find_contender
from bench.law.shipped import shortened
from tasks.base import Start
from tasks.condition import Condition
from tasks.moving_goal import NO_FEEDFORWARD, RATE, reference_rates
from tasks.rotations import about, short_of_180_degrees
from tasks.rules import RULES
from tasks.verdict import SETTLED

KP, KV = 100.0, 20.0
AXIS = (0.48, -0.6, 0.64)
X = (1.0, 0.0, 0.0)


def ended(word, starts, condition, horizon_s=3.0, gains=None, **more):
    chosen = settings(horizon_s=horizon_s, gains=gains)
    return run(find_contender(word), starts, condition, chosen, METRICS, **more)


@pytest.mark.parametrize("word", ["rotation-matrix", "hybrid", "feedback-linearized/zyx-euler", "paielli-bach"])
def test_without_perturbation_it_is_the_sampled_plant_bit_for_bit(word):
    starts = [*tasks.start_set("uniform", 20), *tasks.start_set("tumbling", 10), *tasks.start_set("half-turn")[::20]]
    chosen = settings(horizon_s=2.0, hold_ticks=RULES.hold_ticks(1e-3))
    expected = run_unperturbed("ideal-held", find_contender(word), "free-body", starts, chosen, METRICS)
    rows = run(find_contender(word), starts, Condition(), chosen, METRICS)
    assert same_bits(rows[:, : expected.shape[1]], expected)


EVERYTHING = Condition(
    period_s=2e-3, delay_s=3e-3, attitude_noise=0.01, rate_noise=0.1, worst_attitude_error=0.2, bound=80.0,
    inertia=(0.7, 1.0, 1.4), reference_amplitude=2.0, jump_s=0.02, jump_resets=1,
)  # fmt: skip


@pytest.mark.parametrize("word", ["rotation-matrix", "hybrid"])
def test_compiled_and_plain_loops_agree_bit_for_bit(word):
    one, horizon_s = find_contender(word), 0.1
    starts = [*tasks.start_set("tumbling", 3), *tasks.start_set("half-turn")[:2]]
    rows = blank(len(starts), METRICS, (0.0,) * perturbed.EXTRA)
    given = perturbed.in_steps(numbers(settings()), EVERYTHING, RULES.hold_s, horizon_s)
    noise = draw_noise(0, len(starts), given.ticks, 0)
    plain, world = perturbed.loop_of(observer(METRICS)), perturbed.world(EVERYTHING, noise, rows)
    with np.errstate(all="ignore"):
        simulate(plain, (evaluation_of(one),), world, memory_of(one), start_rows(starts), given, rows)
    assert same_bits(ended(word, starts, EVERYTHING, horizon_s), rows)


def one_axis(angle0, condition, ticks):
    """The rotation-vector law about a fixed axis, a double integrator under a late, held, bounded PD: (angle, settled).

    Between commands theta and its rate are known in closed form; steps of a millisecond or less.
    """
    steps = perturbed.steps_of(condition)
    h = condition.period_s / steps
    late = round(condition.delay_s / h)
    theta, rate, settled, sent = angle0, 0.0, 0, []
    for tick in range(ticks):
        if tick % steps == 0:
            u = -KP * theta - KV * rate
            sent.append(math.copysign(min(abs(u), condition.bound), u))
        acceleration = sent[(tick - late) // steps] / condition.inertia[0] if tick >= late else 0.0
        theta, rate = theta + h * rate + 0.5 * h * h * acceleration, rate + h * acceleration
        if abs(theta) > RULES.band_rad(angle0):
            settled = tick + 2  # the tick after, at the end of this step
    return abs(theta), settled


ONE_AXIS = {
    "as it is": Condition(),
    "20 Hz": Condition(period_s=0.05),
    "300 Hz": Condition(period_s=1.0 / 300.0),
    "10 kHz": Condition(period_s=1e-4),
    "late by a step": Condition(delay_s=1e-3),
    "late by 20 ms": Condition(delay_s=0.02),
    "late within a period": Condition(period_s=0.01, delay_s=0.003),
    "late by more than a period": Condition(period_s=0.01, delay_s=0.017),
    "bounded": Condition(bound=20.0),
    "bounded and late": Condition(bound=20.0, delay_s=0.01),
    "light": Condition(inertia=(0.5, 0.5, 0.5)),
    "heavy": Condition(inertia=(2.0, 2.0, 2.0)),
}


@pytest.mark.parametrize("condition", ONE_AXIS.values(), ids=ONE_AXIS)
def test_about_one_axis_it_is_a_recursion_of_two_numbers(condition):
    starts = [Start(f"{angle}", about(AXIS, angle)) for angle in (0.3, 1.5, 3.0)]
    rows = ended("rotation-vector", starts, condition)
    for row, angle0 in zip(rows, (0.3, 1.5, 3.0), strict=True):
        final, settled = one_axis(angle0, condition, int(row[TICKS]))
        assert row[FINAL_ANGLE] == pytest.approx(final, rel=1e-9, abs=1e-13)
        assert row[SETTLING_TICK] == settled


def test_a_bound_is_never_exceeded_and_keeps_the_direction():
    rows = ended("rotation-matrix", tasks.start_set("tumbling", 20), Condition(bound=30.0))
    peak = FIRST_METRIC + [one.column for one in METRICS].index("peak_u")
    np.testing.assert_allclose(rows[:, peak], 30.0**2, rtol=1e-14)  # all of them reach it; kept squared
    assert shortened((3.0, 0.0, 4.0), 1.0) == pytest.approx((0.6, 0.0, 0.8), rel=1e-15)


def test_small_noise_adds_up_as_it_does_in_the_linear_loop():
    """About the goal each axis is theta' = theta + h w + h^2/2 u, w' = w + h u, u = -Kp (theta + n) - Kv (w + m)."""
    condition, size, h = Condition(attitude_noise=1e-6, rate_noise=1e-5), 1e-6, 1e-3
    rows = ended("rotation-matrix", [Start("at the goal", (1.0, 0.0, 0.0, 0.0))], condition, horizon_s=2.0)
    theta, rate, squares = np.zeros(3), np.zeros(3), []
    for n in draw_noise(0, 1, 2001, 0)[0, :2000]:
        u = -KP * (theta + size * n[:3]) - KV * (rate + 10.0 * size * n[3:])
        theta, rate = theta + h * rate + 0.5 * h * h * u, rate + h * u
        squares.append(theta @ theta)
    assert rows[0, FINAL_ANGLE] == pytest.approx(math.sqrt(squares[-1]), rel=1e-4)
    tail = rows[0, -perturbed.EXTRA :]
    assert tail[perturbed.TAIL_COUNT] == 1000
    assert tail[perturbed.TAIL_SQUARES] == pytest.approx(sum(squares[1000:]), rel=1e-4)
    assert tail[perturbed.TAIL_WORST] ** 2 == pytest.approx(max(squares[1000:]), rel=1e-4)


def test_starts_in_blocks_of_noise_give_the_same_rows():
    given = "hybrid", tasks.start_set("tumbling", 5), EVERYTHING, 0.1
    two_starts = 2.0 * 8 * 6 * 51  # of 51 periods
    assert same_bits(ended(*given, noise_bytes=two_starts), ended(*given))


def test_noise_is_that_of_its_seed_and_start_alone():
    few, many = draw_noise(0, 2, 50, 3), draw_noise(0, 4, 50, 3)
    assert same_bits(few, many[:2])
    assert not same_bits(draw_noise(0, 2, 50, 4), few)
    assert abs(draw_noise(0, 4, 5000, 0).std() - 1.0) < 0.01


AXES = (X, AXIS, (1.0, 1.0, 1.0), (-0.3, 0.2, 0.9))
HALF_TURNS = [Start(f"{axis}", short_of_180_degrees(axis, 0.0)) for axis in AXES]


@pytest.mark.parametrize("word", ["square-root", "quaternion-shortest", "rotation-vector", "mrp", "sliding"])
@pytest.mark.parametrize(("beyond", "period_s"), [(0.1, 1e-3), (1e-3, 1e-3), (1e-5, 1e-4)])
def test_the_worst_noise_holds_a_law_without_memory_at_the_half_turn(word, beyond, period_s):
    """Any noise larger than the turn of one period, some Kp f(pi) period^2: asked more often, it is held by less."""
    rows = ended(word, HALF_TURNS, Condition(worst_attitude_error=beyond, period_s=period_s), horizon_s=2.0)
    assert np.all(np.abs(rows[:, FINAL_ANGLE] - math.pi) < 2.0 * beyond)
    assert np.all(ended(word, HALF_TURNS, Condition(period_s=period_s))[:, OUTCOME] == SETTLED)


WIDTH = {
    **dict.fromkeys(("hybrid", "rotation-vector-memory", "mrp-memory", "sliding-memory"), 2.0 * math.asin(0.4)),
    "late-braking": math.pi / 3.0,
}
"""Angle beyond 180° at which a law leaves the side it remembers: where the reported eta is -0.4, or -1/2."""


@pytest.mark.parametrize("word", WIDTH)
@pytest.mark.parametrize(("share", "is_held"), [(0.0, False), (0.1, False), (0.95, False), (1.05, True)])
def test_law_with_a_memory_resists_the_worst_noise_up_to_its_width(word, share, is_held):
    rows = ended(word, HALF_TURNS, Condition(worst_attitude_error=share * WIDTH[word]))
    assert np.all((rows[:, OUTCOME] == SETTLED) != is_held)


@pytest.mark.parametrize("inertia", [(0.5, 1.0, 1.5), (0.9, 1.0, 1.1), (1.0, 1.0, 1.4)])
def test_an_uneven_body_obeys_eulers_equations(inertia):
    """Under a torque held in the base frame, by scipy."""
    turn, J = ScipyRotation.from_euler("ZYX", [0.4, -0.3, 1.1]), np.array(inertia)
    R, omega, u = of_scipy(turn), (3.0, -5.0, 8.0), (20.0, -10.0, 5.0)

    def rate(_, turn, omega, __):
        W = turn.inv().apply(omega)
        return turn.apply((turn.inv().apply(u) - np.cross(W, J * W)) / J), ()

    expected, turning, _ = path(rate, turn, omega, [0.2], rtol=1e-12)
    for _ in range(200):
        R, omega = rigid_body.step(R, omega, u, inertia, 1e-3)
    np.testing.assert_allclose(matrix(R), expected[0].as_matrix(), atol=1e-9)
    np.testing.assert_allclose(omega, turning[0], atol=1e-8)


RELATIVE = ["rotation-matrix", "square-root", "rotation-vector", "mrp-linearized", "paielli-bach", "sliding", "hybrid"]


@pytest.mark.parametrize("word", RELATIVE)
def test_told_rate_and_acceleration_a_law_moves_about_its_goal_as_about_one_at_rest(word):
    """Started with the goal's own velocity, the error takes the course of regulation from rest, but for the hold."""
    still = [Start(f"{angle}", about(AXIS, angle)) for angle in (0.5, 1.6, 2.9)]
    moving = [start._replace(omega=reference_rates(0.0, 5.0)[0]) for start in still]
    condition = Condition(period_s=1e-4)
    expected = ended(word, still, condition, horizon_s=1.0)
    rows = ended(word, moving, condition._replace(reference_amplitude=5.0), horizon_s=1.0)
    np.testing.assert_allclose(rows[:, SETTLING_TICK], expected[:, SETTLING_TICK], atol=6)
    np.testing.assert_allclose(rows[:, FINAL_ANGLE], expected[:, FINAL_ANGLE], atol=6e-4)


def test_lag_without_feedforward_is_larger_than_with_feedforward_of_the_rate():
    """Behind a goal of rate r a PD lags by about Kv r / Kp; told the rate, by its acceleration over Kp."""
    start = [Start("still", (1.0, 0.0, 0.0, 0.0))]
    tails = []
    for told in (NO_FEEDFORWARD, RATE):
        extra = ended("rotation-vector", start, Condition(reference_amplitude=0.5, feedforward=told), horizon_s=4.0)[
            0, -perturbed.EXTRA :
        ]
        tails.append(math.sqrt(extra[perturbed.TAIL_SQUARES] / extra[perturbed.TAIL_COUNT]))
    times = np.linspace(3.0, 4.0, 1000)
    rates, accelerations = (np.array([reference_rates(t, 0.5)[i] for t in times]) for i in (0, 1))
    assert tails[0] == pytest.approx(KV / KP * np.sqrt((rates**2).sum(1).mean()), rel=0.15)
    assert tails[1] == pytest.approx(np.sqrt((accelerations**2).sum(1).mean()) / KP, rel=0.15)


def test_episodes_stop_early_where_a_perturbation_ends_with_the_error_and_not_where_it_lasts():
    starts = tasks.start_set("uniform", 5)
    assert np.all(ended("square-root", starts, Condition(bound=100.0))[:, TICKS] < 2000)
    for lasting in (Condition(rate_noise=1e-6), Condition(reference_amplitude=0.1)):
        assert np.all(ended("square-root", starts, lasting)[:, TICKS] == 3000)
