"""Every sequence of Euler angles against scipy and closed form; its extraction differentiated, against 80 digits."""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support import exact
from support.bits import EPS
from support.states import as_rotation, matrix, rotations, vector

import tasks
from bench.law.contenders.registry import contenders, representation
from bench.law.so3 import Rotation, cross
from tasks.rotations import columns, on_pole

# The bound of test_every_representation: sums of three products of up to three rounded factors.
TOLERANCE = 10 * EPS


SEQUENCES = {
    "zyx-euler": ("ZYX", (-math.pi / 2, math.pi / 2)),
    "zyz-euler": ("ZYZ", (0.0, math.pi)),
    "xyz-euler": ("XYZ", (-math.pi / 2, math.pi / 2)),
}
"""scipy's word, and the two poles."""
each = pytest.mark.parametrize(
    ("one", "axes", "poles"), [(representation(word), *given) for word, given in SEQUENCES.items()], ids=SEQUENCES
)


def drawn(beta, seed=6):
    """Twenty triples of angles with that middle one."""
    draw = np.random.default_rng(seed)
    return [vector((a, beta, c)) for a, c in draw.uniform(-math.pi, math.pi, (20, 2))]


@each
def test_rotation_is_scipys(one, axes, poles):
    distances = [10.0**-k for k in (1, 4, 8, 12)]
    nearby = [*(poles[0] + distance for distance in distances), *(poles[1] - distance for distance in distances)]
    for beta in (*(sum(poles) / 2.0 + np.linspace(-1.4, 1.4, 9)), *nearby, *poles):
        for E in drawn(beta):
            expected = ScipyRotation.from_euler(axes, E).as_matrix()
            np.testing.assert_allclose(matrix(one.to_matrix(E)), expected, rtol=0.0, atol=TOLERANCE)


@each
def test_angles_are_scipys_away_from_the_poles(one, axes, poles):
    sets = ("half-turn", "wraps")
    for start in tasks.start_set("uniform", 300, seed=7) + [each for word in sets for each in tasks.start_set(word)]:
        R = as_rotation(columns(start.quat_wxyz))
        away = one.margin(R)
        if away < 1e-6:  # scipy sets the third angle to zero within 1e-7 of a pole
            continue
        E = np.array(one.chart(R).E)
        difference = E - ScipyRotation.from_quat(start.quat_wxyz, scalar_first=True).as_euler(axes)
        difference[[0, 2]] = (difference[[0, 2]] + math.pi) % (2.0 * math.pi) - math.pi
        # rounding of R moves the outer two by its size over the margin
        assert np.abs(difference).max() <= TOLERANCE / away + 4 * EPS, start.id
        assert np.abs(E).max() <= math.pi


def about_y(sign, gamma):
    """90 degrees about Y after a turn about X, with exact zeros and ones."""
    s, c = math.sin(gamma), math.cos(gamma)
    return [(0.0, s, -sign * c), (0.0, c, sign * s), (sign, 0.0, 0.0)]


TURNS = (0.5, 2.5, -1.4, math.pi / 2, -math.pi / 2)
POLES = [
    *(("zyx-euler", columns(on_pole(sign, -sign * turn)), sign, turn) for sign in (1, -1) for turn in TURNS),
    *(("zyz-euler", columns((math.cos(turn / 2), 0.0, 0.0, math.sin(turn / 2))), 0, turn) for turn in (0.0, *TURNS)),
    *(("xyz-euler", about_y(sign, turn), sign, turn) for sign in (1, -1) for turn in TURNS),
]


@pytest.mark.parametrize(("word", "R", "quarters", "gamma"), POLES)
def test_pole_puts_the_whole_turn_into_gamma(word, R, quarters, gamma):
    one, R = representation(word), as_rotation(R)
    assert one.margin(R) == 0.0
    E = one.chart(R).E
    assert E[:2] == (0.0, quarters * math.pi / 2)
    assert E[2] == pytest.approx(gamma, abs=TOLERANCE)


@each
def test_margin_is_the_sine_of_the_distance_from_the_pole(one, axes, poles):
    for beta in np.linspace(*poles, 41):
        found = one.margin(one.to_matrix(vector((0.7, beta, -2.0))))
        assert found == pytest.approx(math.sin(abs(beta - poles[0])), abs=2 * EPS)


DIFFERENTIATED = [one for one in contenders("representations").values() if one.differentiate is not None]


on_differentiated = pytest.mark.parametrize("one", DIFFERENTIATED)


def turning(omega, R) -> Rotation:
    return Rotation(*(cross(omega, column) for column in R))


@functools.cache
def path(one, E, Edot, Eddot):
    """R, Rdot and Rddot of E + Edot t + Eddot t^2/2 at t = 0, rounded."""
    found = exact.path(one.to_matrix, E, Edot, Eddot)
    return [as_rotation(np.array(A.T.tolist(), dtype=float)) for A in found]


@on_differentiated
def test_derivatives_along_a_path_are_the_paths_own(one):
    """The oracle starts from the coordinates: neither the extraction nor B is in it."""
    draw = np.random.default_rng(3)
    for R in rotations():
        near = one.margin(R)
        if near > 1e-5:  # the path's own coordinates are lost, by EPS/margin^2, nearer the pole
            Edot, Eddot = (vector(draw.normal(scale=scale, size=3)) for scale in (5.0, 50.0))
            along = path(one, one.chart(R).E, Edot, Eddot)
            first, second = np.abs(Edot).max() / near, np.abs(Eddot).max() / near + (np.abs(Edot).max() / near) ** 2
            found = one.differentiate(*along[:2])
            np.testing.assert_allclose(found, Edot, rtol=0.0, atol=TOLERANCE * first / near)
            found = one.differentiate_twice(*along)
            np.testing.assert_allclose(found, Eddot, rtol=0.0, atol=3 * TOLERANCE * second / near)


@on_differentiated
def test_derivatives_are_not_finite_on_the_poles(one):
    omega = vector((0.3, -0.7, 1.1))
    poles = [R for R in rotations() if one.margin(R) == 0.0]
    assert poles
    for R in poles:
        Rdot = turning(omega, R)
        Rddot = as_rotation(np.add(Rdot, turning(omega, Rdot)))
        with np.errstate(all="ignore"):
            assert not np.isfinite(one.differentiate(R, Rdot)).all()
            assert not np.isfinite(one.differentiate_twice(R, Rdot, Rddot)).all()
