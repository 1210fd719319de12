"""Contracts that every representation in bench/representations keeps; a new file is under them unnamed.

The oracle is the representation's own to_matrix, evaluated and differentiated with 80 digits (exact.py); that
to_matrix is the rotation its title says is tested for each representation by itself.
"""

import functools

import numpy as np
import pytest
from bits import EPS, different_rows
from exact import EXACT, exact_B, motion, rows_of, solved
from states import axis_permuting, matrix, rotations, vector

from bench.discovery import known_representations
from bench.engines.compiled import MATRIX, compile_function
from bench.so3 import Rotation

# Three coordinates of size up to pi, each within one last place (2 EPS) of its true value, move R by up to
# 6 EPS; the R given is orthonormal to 2 EPS, and building it again rounds by as much.
ROUND_TRIP_TOLERANCE = 10 * EPS
# Sums of three products, of two or three factors each of which carries up to three roundings.
PRODUCT_TOLERANCE = 10 * EPS
# |det B| of a B computed from coordinates that are pi/2 to rounding, where the true one is 0.
VANISHING = 4 * EPS


@pytest.fixture(params=known_representations().values(), ids=lambda representation: representation.name)
def representation(request):
    return request.param


@pytest.fixture
def draw():
    return np.random.default_rng(5)


@functools.cache
def exact_B_at(representation, E):
    return exact_B(representation.to_matrix, E)


def charts(representation, R):
    """The chart of R, and the chart of its coordinates: two ways to the same point."""
    at = representation.chart(R)
    return at, representation.chart_of(at.E)


def size(numbers) -> float:
    return float(max(abs(x) for x in numbers))


def errors(given, exact) -> float:
    """Largest difference of doubles from numbers of 80 digits."""
    return size(EXACT.mpf(g) - e for g, e in zip(given, exact, strict=True))


def test_round_trip_rebuilds_every_orientation_to_rounding(representation):
    for R in rotations():
        rebuilt = representation.to_matrix(representation.chart(R).E)
        np.testing.assert_allclose(matrix(rebuilt), matrix(R), rtol=0.0, atol=ROUND_TRIP_TOLERANCE)


def test_coordinates_are_finite_at_every_orientation(representation):
    assert all(np.isfinite(representation.chart(R).E).all() for R in rotations())


def test_angular_velocity_is_the_derivative_of_to_matrix(representation, draw):
    for R in rotations():
        Edot = vector(draw.normal(scale=5.0, size=3))
        for at in charts(representation, R):
            expected, _ = motion(representation.to_matrix, at.E, Edot)
            error = errors(representation.angular_velocity(at, Edot), expected)
            assert error <= PRODUCT_TOLERANCE * size(Edot), (R, Edot)


def test_accelerate_is_the_second_derivative_of_to_matrix(representation, draw):
    for R in rotations():
        Edot, Eddot = vector(draw.normal(scale=5.0, size=3)), vector(draw.normal(scale=100.0, size=3))
        for at in charts(representation, R):
            _, expected = motion(representation.to_matrix, at.E, Edot, Eddot)
            error = errors(representation.accelerate(at, Edot, Eddot), expected)
            assert error <= PRODUCT_TOLERANCE * (size(Eddot) + size(Edot) ** 2), (R, Edot, Eddot)


def test_rates_are_the_inverse_of_the_derivative_of_to_matrix(representation, draw):
    """Relative to |B^-1| |omega|, however near the singular set: the inverse loses no digits that B has."""
    for R in rotations():
        omega = vector(draw.normal(scale=5.0, size=3))
        if representation.margin(R) > 0.0:
            at = representation.chart_of(representation.chart(R).E)
            B = exact_B_at(representation, at.E)
            inverse_size = max(size(row) for row in rows_of(B**-1))
            error = errors(representation.rates(at, omega), solved(B, omega))
            assert error <= PRODUCT_TOLERANCE * inverse_size * size(omega), (R, omega)


def test_rates_undo_angular_velocity_up_to_the_singular_set(representation, draw):
    for R in rotations():
        omega = vector(draw.normal(scale=5.0, size=3))
        margin = representation.margin(R)
        if margin > 0.0:
            for at in charts(representation, R):
                again = representation.angular_velocity(at, representation.rates(at, omega))
                # rates as large as |omega| / margin are added up again
                np.testing.assert_allclose(
                    again, omega, rtol=0.0, atol=PRODUCT_TOLERANCE * size(omega) * (1.0 + 1.0 / margin)
                )


def test_generalized_is_the_transpose_of_B(representation, draw):
    for R in rotations():
        moment = vector(draw.normal(size=3))
        for at in charts(representation, R):
            B = exact_B_at(representation, at.E)
            expected = list(B.T * EXACT.matrix([EXACT.mpf(m) for m in moment]))
            assert errors(representation.generalized(at, moment), expected) <= PRODUCT_TOLERANCE * size(moment)


def test_generalized_force_has_the_power_of_the_moment(representation, draw):
    """m . omega = (B^T m) . Edot at every orientation (Murphy 1988, 3.10)."""
    for R in rotations():
        moment, Edot = vector(draw.normal(size=3)), vector(draw.normal(size=3))
        at = representation.chart(R)
        power = np.dot(moment, representation.angular_velocity(at, Edot))
        # two sums of three products more than each factor has
        tolerance = 6 * PRODUCT_TOLERANCE * size(moment) * size(Edot)
        assert abs(np.dot(representation.generalized(at, moment), Edot) - power) <= tolerance


def test_margin_is_a_share(representation):
    # R is orthonormal to 2 EPS, so its elements may exceed 1 by as much
    assert all(0.0 <= representation.margin(R) <= 1.0 + 2.0 * EPS for R in rotations())


def test_margin_is_zero_exactly_where_B_is_singular(representation):
    for R in rotations():
        determinant = abs(EXACT.det(exact_B_at(representation, representation.chart(R).E)))
        if representation.margin(R) == 0.0:
            assert determinant <= VANISHING, R
        elif R in axis_permuting():  # exact in doubles: here nothing may round to "nearly singular"
            assert determinant > VANISHING, R


def test_margin_is_above_zero_off_the_singular_set(representation):
    """The judge's nearest starts are 1e-12 rad from a singular orientation: well above rounding, not on it."""
    for R in rotations():
        determinant = abs(EXACT.det(exact_B_at(representation, representation.chart(R).E)))
        if determinant > VANISHING:
            assert representation.margin(R) > 0.0, R


def test_B_exists_and_its_inverse_does_not_on_the_singular_set(representation):
    x = (np.float64(0.3), np.float64(-0.7), np.float64(1.1))
    for R in rotations():
        if representation.margin(R) == 0.0:
            at = representation.chart(R)
            assert np.isfinite(representation.angular_velocity(at, x)).all()
            assert np.isfinite(representation.accelerate(at, x, x)).all()
            assert np.isfinite(representation.generalized(at, x)).all()
            with np.errstate(all="ignore"):
                assert not np.isfinite(representation.rates(at, x)).all(), R


def all_of(representation):
    """Every kernel of the representation in one function, rows in and rows out."""
    chart, chart_of, to_matrix = representation.chart, representation.chart_of, representation.to_matrix
    rates, accelerate = representation.rates, representation.accelerate
    angular_velocity, generalized, margin = (
        representation.angular_velocity,
        representation.generalized,
        representation.margin,
    )

    def over(given, out):
        for row, into in zip(given, out):  # noqa: B905  numba's zip takes no strict
            R = Rotation((row[0], row[1], row[2]), (row[3], row[4], row[5]), (row[6], row[7], row[8]))
            x, y = (row[9], row[10], row[11]), (row[12], row[13], row[14])
            at = chart(R)
            again = chart_of(at.E)
            rebuilt = to_matrix(at.E)
            into[0], into[1], into[2] = at.E
            into[3], into[4], into[5] = rebuilt.n
            into[6], into[7], into[8] = rebuilt.o
            into[9], into[10], into[11] = rebuilt.a
            into[12], into[13], into[14] = rates(at, x)
            into[15], into[16], into[17] = accelerate(at, x, y)
            into[18], into[19], into[20] = angular_velocity(at, x)
            into[21], into[22], into[23] = generalized(at, x)
            into[24], into[25], into[26] = rates(again, x)
            into[27], into[28], into[29] = accelerate(again, x, y)
            into[30], into[31], into[32] = angular_velocity(again, x)
            into[33], into[34], into[35] = generalized(again, x)
            into[36] = margin(R)

    return over


COLUMNS_OF_ALL = 37


def test_compiled_calls_are_the_plain_calls_bit_for_bit(representation, draw):
    given = np.array([[*R.n, *R.o, *R.a, *draw.normal(scale=5.0, size=6)] for R in rotations()])
    plain, compiled = np.empty((2, len(given), COLUMNS_OF_ALL))
    over = all_of(representation)
    with np.errstate(all="ignore"):
        over(given, plain)
    compile_function(over, (MATRIX, MATRIX), cache=False)(given, compiled)
    assert different_rows(compiled, plain) == []
