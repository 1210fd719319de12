"""The extractions differentiated element by element (Murphy 1988, 3.5), against 80 digits and B^-1."""

import functools

import numpy as np
import pytest
from support.bits import EPS
from support.exact import EXACT, STEP, exact_matrix
from support.states import as_rotation, rotations, vector

from bench.law.contenders.registry import contenders
from bench.law.so3 import Rotation, cross

DIFFERENTIATED = [one for one in contenders("representations").values() if one.differentiate is not None]

# An element of R errs by 2 EPS and its derivatives by as much of their size; quotients of two products of such
# elements carry 10 EPS, over a denominator as small as the margin's square.
TOLERANCE = 10 * EPS


@pytest.fixture(params=DIFFERENTIATED, ids=lambda one: one.name)
def representation(request):
    return request.param


def turning(omega, R) -> Rotation:
    return Rotation(*(cross(omega, column) for column in R))


def bending(omegadot, omega, R) -> Rotation:
    first, second = turning(omegadot, R), turning(omega, turning(omega, R))
    return as_rotation(np.array(first) + np.array(second))


@functools.cache
def path(representation, E, Edot, Eddot):
    """R, Rdot and Rddot of E + Edot t + Eddot t^2/2 at t = 0: to_matrix differentiated with 80 digits, rounded."""

    def at(t):
        terms = zip(E, Edot, Eddot, strict=True)
        return exact_matrix(representation.to_matrix, [EXACT.mpf(e) + t * d + t * t * a / 2 for e, d, a in terms])

    behind, here, ahead = at(-STEP), at(EXACT.mpf(0)), at(STEP)
    found = here, (ahead - behind) / (2 * STEP), (ahead - 2 * here + behind) / STEP**2
    return [as_rotation([[float(A[i, j]) for i in range(3)] for j in range(3)]) for A in found]


def test_derivatives_along_a_path_are_the_paths_own(representation):
    """The oracle starts from the coordinates: neither the extraction nor B is in it."""
    draw = np.random.default_rng(3)
    for R in rotations():
        near = representation.margin(R)
        if near > 1e-5:  # the path's own coordinates are lost, by EPS/margin^2, nearer the pole
            E, Edot, Eddot = (
                representation.chart(R).E,
                vector(draw.normal(scale=5.0, size=3)),
                vector(draw.normal(scale=50.0, size=3)),
            )
            along = path(representation, E, Edot, Eddot)
            first, second = np.abs(Edot).max() / near, np.abs(Eddot).max() / near + (np.abs(Edot).max() / near) ** 2
            found = representation.differentiate(*along[:2])
            np.testing.assert_allclose(found, Edot, rtol=0.0, atol=TOLERANCE * first / near)
            found = representation.differentiate_twice(*along)
            np.testing.assert_allclose(found, Eddot, rtol=0.0, atol=3 * TOLERANCE * second / near)


def test_derivatives_are_not_finite_on_the_poles(representation):
    omega = vector((0.3, -0.7, 1.1))
    poles = [R for R in rotations() if representation.margin(R) == 0.0]
    assert poles
    for R in poles:
        Rdot, Rddot = turning(omega, R), bending(omega, omega, R)
        with np.errstate(all="ignore"):
            assert not np.isfinite(representation.differentiate(R, Rdot)).all()
            assert not np.isfinite(representation.differentiate_twice(R, Rdot, Rddot)).all()
