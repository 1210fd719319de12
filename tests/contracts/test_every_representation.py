"""Contracts that every representation in bench/law/contenders/representations keeps; a new file is under them unnamed.

The oracle is the representation's own to_matrix, evaluated and differentiated with 80 digits (exact.py); that
to_matrix is the rotation its title says is tested for each representation by itself.
"""

import functools
from collections import defaultdict

import numpy as np
import pytest
from support.bits import EPS
from support.buffers import different_calls
from support.each import each
from support.exact import EXACT, exact_B, motion
from support.states import axis_permuting, matrix, near_identity, rotations, vector

from bench.law.contenders.registry import contenders
from bench.law.so3 import Rotation

# Three coordinates of size up to pi, each within one last place (2 EPS) of its true value, move R by up to
# 6 EPS; the R given is orthonormal to 2 EPS, and building it again rounds by as much.
ROUND_TRIP_TOLERANCE = 10 * EPS
# Sums of three products, of two or three factors each of which carries up to three roundings.
PRODUCT_TOLERANCE = 10 * EPS
# |det B| of a B computed from coordinates that are pi/2 to rounding, where the true one is 0.
VANISHING = 4 * EPS

representation = each(contenders("representations").values())


@pytest.fixture
def draw():
    return np.random.default_rng(5)


@functools.cache
def some_rotations(representation) -> tuple:
    """Return rotations for tests in 80 digits: the exact ones, those near the identity, and a sixth of the others. Each
    representation has a draw of its own."""
    every = rotations()
    always = len(axis_permuting()) + len(near_identity())
    seed = list(contenders("representations")).index(representation.name)
    drawn = np.random.default_rng(seed).permutation(len(every) - always)
    return (*every[:always], *(every[always + i] for i in sorted(drawn[: len(drawn) // 6])))


@functools.cache
def exact_B_at(representation, E):
    return exact_B(representation.to_matrix, E)


def charts(representation, R):
    """The chart of R, and the chart of its coordinates: two ways to the same point."""
    at = representation.chart(R)
    return at, representation.chart_of(at.E)


def coordinates(representation, draw, scale):
    """Draw as many numbers as it has coordinates."""
    return vector(draw.normal(scale=scale, size=len(representation.symbols)))


def velocity(representation, R, draw):
    """An Edot a rotation can have: any three numbers; of a quaternion what is perpendicular to it."""
    Edot = np.array(coordinates(representation, draw, 5.0))
    if len(Edot) > 3:
        E = np.array(representation.chart(R).E)
        Edot = Edot - np.dot(Edot, E) * E
    return vector(Edot)


def size(numbers) -> float:
    return float(max(abs(x) for x in numbers))


def times(A, v) -> list:
    """A v to 80 digits."""
    return list(A * EXACT.matrix([EXACT.mpf(x) for x in v]))


def norm_of(A) -> float:
    """The largest sum of a row's sizes: how much A can magnify the largest of the numbers it is given."""
    return float(EXACT.mnorm(A, EXACT.inf))


def test_round_trip_rebuilds_every_orientation_to_rounding(representation):
    for R in rotations():
        rebuilt = representation.to_matrix(representation.chart(R).E)
        np.testing.assert_allclose(matrix(rebuilt), matrix(R), rtol=0.0, atol=ROUND_TRIP_TOLERANCE)


def test_kernels_are_the_derivatives_of_to_matrix_its_inverse_and_its_transpose(representation, draw):
    """With 80 digits; rates relative to |B^-1| |omega|, however near the singular set: no digit is lost that B has."""
    for R in some_rotations(representation):
        omega, moment = vector(draw.normal(scale=5.0, size=3)), vector(draw.normal(size=3))
        Edot, Eddot = velocity(representation, R, draw), coordinates(representation, draw, 100.0)
        for at in charts(representation, R):
            B = exact_B_at(representation, at.E)
            first, second = motion(representation.to_matrix, at.E, Edot, Eddot)
            found = [
                (representation.angular_velocity(at, Edot), first, norm_of(B) * size(Edot)),
                (representation.accelerate(at, Edot, Eddot), second, norm_of(B) * (size(Eddot) + size(Edot) ** 2)),
                (representation.generalized(at, moment), times(B.T, moment), norm_of(B.T) * size(moment)),
            ]
            if representation.margin(R) > 0.0:
                # of four coordinates the inverse of least norm, which leaves E on its sphere
                inverse = B**-1 if B.cols == 3 else B.T * (B * B.T) ** -1
                rates = representation.rates(representation.chart_of(at.E), omega)
                found.append((rates, times(inverse, omega), norm_of(inverse) * size(omega)))
            for given, expected, scale in found:
                off = size(EXACT.mpf(x) - y for x, y in zip(given, expected, strict=True))
                assert off <= PRODUCT_TOLERANCE * scale, R


def test_margin_is_a_share_and_zero_exactly_where_B_is_singular(representation):
    """The judge's nearest starts are 1e-12 rad from a singular orientation: well above rounding, not on it."""
    # R is orthonormal to 2 EPS, so its elements may exceed 1 by as much
    assert all(0.0 <= representation.margin(R) <= 1.0 + 2.0 * EPS for R in rotations())
    for R in some_rotations(representation):
        B = exact_B_at(representation, representation.chart(R).E)
        # of four coordinates that of the map from the tangent of their sphere
        determinant = abs(EXACT.det(B)) if B.cols == 3 else EXACT.sqrt(EXACT.det(B * B.T))
        if representation.margin(R) == 0.0:
            assert determinant <= VANISHING, R
        elif R in axis_permuting():  # exact in doubles: here nothing may round to "nearly singular"
            assert determinant > VANISHING, R


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


def test_counted_and_compiled_kernels_give_the_bits_of_the_plain_ones(representation, draw):
    calls = defaultdict(list)
    for R in rotations():
        x, rate, bend = (
            vector(draw.normal(scale=5.0, size=3)),
            *(coordinates(representation, draw, 5.0) for _ in "12"),
        )
        at, again = charts(representation, R)
        for name, given in (("chart", R), ("margin", R), ("chart_of", at.E), ("to_matrix", at.E)):
            calls[name].append((given,))
        for point in (at, again):
            for name, given in (("rates", x), ("generalized", x), ("angular_velocity", rate)):
                calls[name].append((point, given))
            calls["accelerate"].append((point, rate, bend))
        if representation.differentiate is not None:
            calls["differentiate"].append((R, Rotation(x, rate, bend)))
            calls["differentiate_twice"].append((R, Rotation(x, rate, bend), Rotation(bend, x, rate)))
    for name, given in calls.items():
        assert different_calls(getattr(representation, name), given) == [], name
