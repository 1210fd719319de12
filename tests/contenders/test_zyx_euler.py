"""Z-Y-X Euler angles against sympy and scipy, and what the paper says of their poles (Murphy 1988, 2.2)."""

import functools
import math

import numpy as np
import pytest
import sympy
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import as_rotation, matrix, vector

import tasks
from bench.contenders.registry import representation
from tasks.rotations import columns, on_pole

ZYX = representation("zyx-euler")

alpha, beta, gamma = E = sympy.symbols("alpha beta gamma", real=True)
Edot = sympy.Matrix(sympy.symbols("alphadot betadot gammadot", real=True))
Eddot = sympy.Matrix(sympy.symbols("alphaddot betaddot gammaddot", real=True))


def derivative(expression):
    """d/dt along a path of coordinates."""
    variables, velocities = (*E, *Edot), (*Edot, *Eddot)
    terms = (sympy.diff(expression, x) * xdot for x, xdot in zip(variables, velocities, strict=True))
    return sum(terms, sympy.zeros(*expression.shape))


@functools.cache
def symbolic():
    """R, and omega as the vector of the skew Rdot R^T (Murphy 1988, 2.7), in symbols."""
    R = sympy.rot_ccw_axis3(alpha) * sympy.rot_ccw_axis2(beta) * sympy.rot_ccw_axis1(gamma)
    skew = derivative(R) * R.T
    return R, sympy.simplify(sympy.Matrix([skew[2, 1], skew[0, 2], skew[1, 0]]))


@functools.cache
def numbers_of():
    """(E, Edot, Eddot) -> R, B, omega, omegadot, with the digits of mpmath."""
    R, omega = symbolic()
    return sympy.lambdify([E, list(Edot), list(Eddot)], [R, omega.jacobian(Edot), omega, derivative(omega)], "mpmath")


PRINTED_B = sympy.Matrix(  # Murphy 1988, 2.8
    [
        [0, -sympy.sin(alpha), sympy.cos(alpha) * sympy.cos(beta)],
        [0, sympy.cos(alpha), sympy.sin(alpha) * sympy.cos(beta)],
        [1, 0, -sympy.sin(beta)],
    ]
)
PRINTED_INVERSE = sympy.Matrix(  # Murphy 1988, 2.9
    [
        [sympy.cos(alpha) * sympy.tan(beta), sympy.sin(alpha) * sympy.tan(beta), 1],
        [-sympy.sin(alpha), sympy.cos(alpha), 0],
        [sympy.cos(alpha) / sympy.cos(beta), sympy.sin(alpha) / sympy.cos(beta), 0],
    ]
)
# The same bound as in test_every_representation: sums of three products of up to three rounded factors.
TOLERANCE = 10 * EPS
BETAS = (
    0.0,
    0.4,
    -1.2,
    *(sign * (math.pi / 2 - 10.0**-k) for k in (1, 4, 8, 12) for sign in (1, -1)),
    math.pi / 2,
)


def test_B_as_printed_is_the_derivative_of_the_rotation():
    B = symbolic()[1].jacobian(Edot)
    assert sympy.simplify(B - PRINTED_B) == sympy.zeros(3)


def test_inverse_of_B_as_printed_is_its_inverse():
    assert sympy.simplify(PRINTED_INVERSE * PRINTED_B) == sympy.eye(3)


@pytest.mark.parametrize("beta", BETAS)
def test_kernels_are_their_symbolic_formulas_at_around_and_away_from_the_poles(beta):
    draw = np.random.default_rng(6)
    for _ in range(20):
        angles = (*draw.uniform(-math.pi, math.pi, 1), np.float64(beta), *draw.uniform(-math.pi, math.pi, 1))
        rate, acceleration = draw.normal(scale=5.0, size=3), draw.normal(scale=50.0, size=3)
        rotation, b, omega, alpha = (np.array(x, dtype=float) for x in numbers_of()(angles, rate, acceleration))
        at = ZYX.chart_of(angles)
        given = vector(rate), vector(acceleration)
        close(matrix(ZYX.to_matrix(angles)), rotation.reshape(3, 3), 1.0)
        close(ZYX.angular_velocity(at, given[0]), omega.ravel(), np.abs(rate).max())
        close(ZYX.accelerate(at, *given), alpha.ravel(), np.abs(acceleration).max() + np.abs(rate).max() ** 2)
        close(ZYX.generalized(at, given[0]), b.reshape(3, 3).T @ rate, np.abs(rate).max())


def close(given, expected, scale):
    np.testing.assert_allclose(given, expected, rtol=0.0, atol=TOLERANCE * scale)


def test_angles_are_scipys_away_from_the_poles():
    for start in tasks.start_set("uniform", 300, seed=7) + tasks.start_set("wraps"):
        theirs = ScipyRotation.from_quat(start.quat_wxyz, scalar_first=True).as_euler("ZYX")
        rotation = as_rotation(columns(start.quat_wxyz))
        away = ZYX.margin(rotation)
        difference = np.array(ZYX.chart(rotation).E) - theirs
        # the same angle on either side of a wrap; rounding of R moves alpha and gamma by its size over the margin
        difference[[0, 2]] = (difference[[0, 2]] + math.pi) % (2.0 * math.pi) - math.pi
        assert np.abs(difference).max() <= 10 * EPS / away + 4 * EPS, start.id


def test_angles_of_the_axes_are_turns_about_z_then_y_then_x():
    for i, axis in enumerate(((0, 0, 1), (0, 1, 0), (1, 0, 0))):
        turned = as_rotation(ScipyRotation.from_rotvec(0.3 * np.array(axis)).as_matrix().T)
        np.testing.assert_allclose(ZYX.chart(turned).E, 0.3 * np.eye(3)[i], rtol=0.0, atol=2 * EPS)


@pytest.mark.parametrize(("sign", "kept"), [(1, -1), (-1, 1)])
def test_pole_determines_the_difference_at_plus_and_the_sum_at_minus_90_degrees(sign, kept):
    """C15: at +90 degrees only alpha - gamma, at -90 degrees only alpha + gamma; not the sum at both."""
    draw = np.random.default_rng(8)
    pole = np.float64(sign * math.pi / 2)
    for a, c, shift in draw.uniform(-1.0, 1.0, (50, 3)):
        one = matrix(ZYX.to_matrix(vector((a, pole, c))))
        same = matrix(ZYX.to_matrix(vector((a + shift, pole, c - kept * shift))))
        other = matrix(ZYX.to_matrix(vector((a + shift, pole, c + kept * shift))))
        np.testing.assert_allclose(same, one, rtol=0.0, atol=10 * EPS)
        # the twist changes by twice the shift: two elements move by 2 sin(shift) at least once each
        assert np.abs(other - one).max() >= abs(math.sin(shift))


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("twist", [0.5, math.pi / 2, -math.pi / 2, 2.5])
def test_chart_at_the_pole_puts_the_whole_turn_into_gamma(sign, twist):
    at = ZYX.chart(as_rotation(columns(on_pole(sign, twist))))
    assert at.E[0] == 0.0
    assert at.E[1] == sign * math.pi / 2
    assert at.E[2] == pytest.approx(-sign * twist, abs=10 * EPS)


@pytest.mark.parametrize("sign", [1, -1])
def test_B_exists_at_the_pole_and_loses_one_rank(sign):
    """C16: it is the inverse of B that does not exist."""
    at = ZYX.chart(as_rotation(columns(on_pole(sign, 1.0))))
    found = np.array([ZYX.angular_velocity(at, vector(unit)) for unit in np.eye(3)]).T
    np.testing.assert_allclose(found, [[0, 0, 0], [0, 1, 0], [1, 0, -sign]], rtol=0.0, atol=2 * EPS)
    with np.errstate(all="ignore"):
        assert not np.isfinite(ZYX.rates(at, vector((1.0, 1.0, 1.0)))).all()


def test_singular_orientation_is_90_not_180_degrees_about_y():
    """C14: section 2.2 says 180 degrees about Y, where cos(beta) is 1 and all is regular."""
    half_turn = as_rotation(columns((0.0, 0.0, 1.0, 0.0)))
    quarter_turns = [as_rotation(columns(on_pole(sign, 0.0))) for sign in (1, -1)]
    assert ZYX.margin(half_turn) == 1.0
    assert [ZYX.margin(R) for R in quarter_turns] == [0.0, 0.0]


def test_margin_is_the_cosine_of_beta():
    for beta in np.linspace(-math.pi / 2, math.pi / 2, 41):
        assert ZYX.margin(ZYX.to_matrix(vector((0.7, beta, -2.0)))) == pytest.approx(math.cos(beta), abs=2 * EPS)


def test_angles_jump_by_a_full_turn_at_the_wraps():
    """alpha and gamma just below pi and just above -pi are neighbours on SO(3)."""
    for index in (0, 2):
        below, above = np.zeros((2, 3))
        below[index], above[index] = math.pi - 1e-9, -math.pi + 1e-9
        rotations = [ZYX.to_matrix(vector(angles)) for angles in (below, above)]
        assert np.abs(matrix(rotations[0]) - matrix(rotations[1])).max() < 3e-9
        jump = ZYX.chart(rotations[0]).E[index] - ZYX.chart(rotations[1]).E[index]
        assert jump == pytest.approx(2.0 * math.pi, abs=3e-9)
