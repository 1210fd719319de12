"""What the paper's regulators are, each against its equation (Murphy 1988, 2.12-2.16)."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.exact import EXACT, exact_B, motion, solved
from support.states import as_rotation, axis_permuting, of_scipy, vector

from bench.law.contenders.registry import all_contenders, find_contender
from bench.law.inputs import AT_REST, Gains, Goal
from bench.law.so3 import IDENTITY

GAINS = Gains(kp=100.0, kv=20.0)
REGULAR = 0.05  # margin above which B^-1 is at most 20 times larger than 1


def law(word):
    return find_contender(word).law


def command(word, R, omega=AT_REST, R_d=IDENTITY, gains=GAINS):
    with np.errstate(all="ignore"):
        return np.array(law(word)(R, vector(omega), Goal(R_d), gains))


def angles(R) -> tuple:
    """alpha, beta, gamma of R by scipy."""
    return tuple(ScipyRotation.from_matrix(np.array(R).T).as_euler("ZYX"))


@pytest.fixture
def draw():
    return np.random.default_rng(12)


def regular(draw, count=100):
    """Drawn orientations away from the poles, each with a tumbling velocity."""
    drawn = (of_scipy(r) for r in ScipyRotation.random(2 * count, rng=draw))
    kept = [R for R in drawn if math.hypot(R.n[0], R.n[1]) > REGULAR][:count]
    return zip(kept, draw.normal(scale=5.0, size=(len(kept), 3)), strict=True)


# --------------------------------------------------------------------------- rotation matrix (2.12)-(2.13)


def test_rotation_matrix_command_vanishes_at_every_half_turn_and_only_there(draw):
    """C04, C05: e = sin(theta) k has no other zeros than theta = 0 and pi."""
    for R in axis_permuting():
        trace = R.n[0] + R.o[1] + R.a[2]
        at_rest_point = trace in (3.0, -1.0)
        assert (np.abs(command("rotation-matrix", R)).max() == 0.0) == at_rest_point, R


def test_rotation_matrix_command_does_not_see_a_change_of_body_axes(draw):
    """R Q, R_d Q for any Q: the columns change, their sum of cross products does not."""
    for R, R_d, Q in zip(*(ScipyRotation.random(50, rng=draw) for _ in range(3)), strict=True):
        seen, changed = (
            command("rotation-matrix", of_scipy(R * P), R_d=of_scipy(R_d * P)) for P in (ScipyRotation.identity(), Q)
        )
        np.testing.assert_allclose(changed, seen, rtol=0.0, atol=10 * EPS * GAINS.kp)


# --------------------------------------------------------------------------- linearized Euler (2.14)


def pd_on_angles(R, omega, goal_angles=(0.0, 0.0, 0.0)) -> np.ndarray:
    """Kp (E_d - E) - Kd Edot with scipy's angles and (2.9) as printed."""
    a, b, c = angles(R)
    sa, ca, tb, cb = math.sin(a), math.cos(a), math.tan(b), math.cos(b)
    Edot = np.array([[ca * tb, sa * tb, 1.0], [-sa, ca, 0.0], [ca / cb, sa / cb, 0.0]]) @ omega
    return GAINS.kp * (np.array(goal_angles) - (a, b, c)) - GAINS.kv * Edot


# angles move by 10 EPS over the margin, rates by 10 EPS |omega| over its square
LINEARIZED_TOLERANCE = 10 * EPS * (GAINS.kp / REGULAR + GAINS.kv * 20.0 / REGULAR**2)


@pytest.mark.parametrize(("word", "order"), [("linearized-euler", (2, 1, 0)), ("linearized-euler-literal", (0, 1, 2))])
def test_linearized_euler_feeds_gamma_beta_alpha_back_to_x_y_z_and_as_printed_alpha_beta_gamma(word, order, draw):
    for (R, omega), (R_d, _) in zip(regular(draw), regular(draw), strict=True):
        for aim, aimed in ((IDENTITY, (0.0, 0.0, 0.0)), (R_d, angles(R_d))):
            expected = pd_on_angles(R, omega, aimed)[[*order]]
            found = command(f"{word}/zyx-euler", R, omega, aim)
            np.testing.assert_allclose(found, expected, rtol=0.0, atol=LINEARIZED_TOLERANCE)


def test_linearized_euler_relative_is_linearized_euler_seen_from_the_goal(draw):
    for (R, omega), goal in zip(regular(draw), ScipyRotation.random(100, rng=draw), strict=True):
        R_d = goal.as_matrix()
        moved = as_rotation((R_d @ np.array(R).T).T)
        found = command("linearized-euler-relative/zyx-euler", moved, R_d @ omega, as_rotation(R_d.T))
        expected = R_d @ pd_on_angles(R, omega)[::-1]
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=2 * LINEARIZED_TOLERANCE)


# --------------------------------------------------------------------------- feedback-linearized (2.15)-(2.16)


# Of a quaternion, what is along it moves nothing and drops out: four coordinates are not free to be linear.
LINEAR = [
    one
    for one in all_contenders()
    if one.regulator.name.startswith("feedback-linearized") and len(one.representation.symbols) == 3
]


@pytest.mark.parametrize("one", LINEAR, ids=lambda one: one.name)
def test_feedback_linearized_coordinates_obey_the_linear_equation(one, draw):
    """Eddot = Kp (E_d - E) - Kd Edot (2.16), the plant inverted on 80-digit numbers, without any B of ours.

    omegadot = B Eddot + Bdot Edot; the second term is what a path with Eddot = 0 has.
    """
    at, compared = one.representation, 0
    for (R, omega), (R_d, _) in zip(regular(draw, 60), regular(draw, 60), strict=True):
        if at.margin(R) < REGULAR:
            continue
        compared += 1
        E, E_d = at.chart(R).E, at.chart(R_d).E
        B = exact_B(at.to_matrix, E)
        Edot = solved(B, omega)
        _, bias = motion(at.to_matrix, E, Edot)
        u = command(one.name, R, omega, R_d)
        Eddot = solved(B, [EXACT.mpf(x) - y for x, y in zip(u, bias, strict=True)])
        expected = [GAINS.kp * (d - e) - GAINS.kv * rate for d, e, rate in zip(E_d, E, Edot, strict=True)]
        speed = float(max(abs(rate) for rate in Edot))
        # the command carries 10 EPS of its largest term, and B^-1 magnifies it
        scale = 10 * EPS / REGULAR * (GAINS.kp * 2.0 * math.pi + GAINS.kv * speed + speed**2)
        np.testing.assert_allclose([float(x) for x in Eddot], [float(x) for x in expected], rtol=0.0, atol=scale)
    assert compared >= 40


@pytest.mark.parametrize("word", ["feedback-linearized/zyx-euler", "linearized-euler/zyx-euler"])
def test_euler_commands_are_not_finite_at_the_pole(word):
    """C10: dividing by cos(beta) = 0."""
    poles = [R for R in axis_permuting() if abs(R.n[2]) == 1.0]
    assert len(poles) == 8
    for R in poles:
        assert not np.isfinite(command(word, R, (1.0, 0.5, 0.2))).all()
