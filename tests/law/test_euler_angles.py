"""Every sequence of Euler angles against scipy and closed form, at, near and away from its poles.

That B, its inverse and its derivative are those of the rotation is test_every_representation's.
"""

import math
from typing import NamedTuple

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import as_rotation, matrix, vector

import tasks
from bench.law.contenders.registry import representation
from tasks.rotations import columns, on_pole

# The bound of test_every_representation: sums of three products of up to three rounded factors.
TOLERANCE = 10 * EPS


class Sequence(NamedTuple):
    """scipy's word, the two poles, and what is determined on each: alpha + sign gamma."""

    axes: str
    poles: tuple
    signs: tuple

    @property
    def middle(self) -> float:
        """The angle farthest from both poles."""
        return sum(self.poles) / 2.0

    def near(self, pole, distance):
        """The middle angle so far from a pole, towards the other."""
        return pole + math.copysign(distance, self.middle - pole)


SEQUENCES = {
    # C15: at +90 degrees only alpha - gamma, at -90 degrees only alpha + gamma; not the sum at both
    "zyx-euler": Sequence("ZYX", (math.pi / 2, -math.pi / 2), (-1, 1)),
    "zyz-euler": Sequence("ZYZ", (0.0, math.pi), (1, -1)),
    "xyz-euler": Sequence("XYZ", (math.pi / 2, -math.pi / 2), (1, -1)),
}


@pytest.fixture(params=SEQUENCES)
def word(request):
    return request.param


@pytest.fixture
def one(word):
    return representation(word)


@pytest.fixture
def sequence(word):
    return SEQUENCES[word]


def drawn(beta, seed=6):
    """Twenty triples of angles with that middle one."""
    draw = np.random.default_rng(seed)
    return [vector((a, beta, c)) for a, c in draw.uniform(-math.pi, math.pi, (20, 2))]


def unwrapped(difference):
    """Return the difference of two triples of angles, without wraps."""
    difference[[0, 2]] = (difference[[0, 2]] + math.pi) % (2.0 * math.pi) - math.pi
    return difference


def test_rotation_is_scipys(one, sequence):
    distances = [10.0**-k for k in (1, 4, 8, 12)]
    nearby = [sequence.near(pole, distance) for pole in sequence.poles for distance in distances]
    for beta in (*(sequence.middle + np.linspace(-1.4, 1.4, 9)), *nearby, *sequence.poles):
        for E in drawn(beta):
            expected = ScipyRotation.from_euler(sequence.axes, E).as_matrix()
            np.testing.assert_allclose(matrix(one.to_matrix(E)), expected, rtol=0.0, atol=TOLERANCE)


def test_angles_are_scipys_away_from_the_poles(one, sequence):
    sets = ("half-turn", "wraps")
    for start in tasks.start_set("uniform", 300, seed=7) + [each for word in sets for each in tasks.start_set(word)]:
        R = as_rotation(columns(start.quat_wxyz))
        away = one.margin(R)
        if away < 1e-6:  # scipy sets the third angle to zero within 1e-7 of a pole
            continue
        theirs = ScipyRotation.from_quat(start.quat_wxyz, scalar_first=True).as_euler(sequence.axes)
        # rounding of R moves the outer two by its size over the margin
        difference = unwrapped(np.array(one.chart(R).E) - theirs)
        assert np.abs(difference).max() <= TOLERANCE / away + 4 * EPS, start.id


@pytest.mark.parametrize("k", range(1, 13))
def test_angles_near_the_poles_are_those_the_rotation_was_made_of(one, sequence, k):
    for pole in sequence.poles:
        for E in drawn(sequence.near(pole, 10.0**-k)):
            difference = unwrapped(np.array(one.chart(one.to_matrix(E)).E) - E)
            assert np.abs(difference[[0, 2]]).max() <= TOLERANCE * 10.0**k
            assert abs(difference[1]) <= TOLERANCE


def test_pole_determines_only_the_sum_or_only_the_difference(one, sequence):
    shift = 0.7
    for pole, sign in zip(sequence.poles, sequence.signs, strict=True):
        for E in drawn(np.float64(pole)):
            here, same, other = (
                matrix(one.to_matrix(vector((E[0] + a, pole, E[2] + c))))
                for a, c in ((0.0, 0.0), (shift, -sign * shift), (shift, sign * shift))
            )
            np.testing.assert_allclose(same, here, rtol=0.0, atol=TOLERANCE)
            # what is determined changes by twice the shift: two elements move by 2 sin(shift) at least once each
            assert np.abs(other - here).max() >= math.sin(shift)


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


def test_identity_is_a_pole_of_zyz_only():
    """C13: the rotation that a regulator goes to is where B^-1 does not exist."""
    margins = {word: representation(word).margin(as_rotation(np.eye(3))) for word in SEQUENCES}
    assert margins == {"zyx-euler": 1.0, "zyz-euler": 0.0, "xyz-euler": 1.0}


def test_singular_orientation_is_90_not_180_degrees_about_y():
    """C14: section 2.2 says 180 degrees about Y, where cos(beta) is 1 and all is regular."""
    turned = [(0.0, 0.0, 1.0, 0.0), *(on_pole(sign, 0.0) for sign in (1, -1))]
    assert [representation("zyx-euler").margin(as_rotation(columns(quat))) for quat in turned] == [1.0, 0.0, 0.0]


def test_margin_is_the_sine_of_the_distance_from_the_pole(one, sequence):
    for beta in np.linspace(*sorted(sequence.poles), 41):
        found = one.margin(one.to_matrix(vector((0.7, beta, -2.0))))
        assert found == pytest.approx(math.sin(abs(beta - sequence.poles[0])), abs=2 * EPS)


@pytest.mark.parametrize("index", [0, 2])
def test_outer_angles_jump_by_a_full_turn_at_the_wraps(one, index):
    """Just below pi and just above -pi they are neighbours on SO(3)."""
    below, above = np.full((2, 3), 0.4)
    below[index], above[index] = math.pi - 1e-9, -math.pi + 1e-9
    ends = [one.to_matrix(vector(angles)) for angles in (below, above)]
    assert np.abs(matrix(ends[0]) - matrix(ends[1])).max() < 3e-9
    jump = one.chart(ends[0]).E[index] - one.chart(ends[1]).E[index]
    assert jump == pytest.approx(2.0 * math.pi, abs=1e-8)


@pytest.mark.parametrize("beta", [0.0, 0.4, -1.2, *(sign * (math.pi / 2 - 0.1) for sign in (1, -1))])
def test_B_and_its_inverse_of_zyx_are_as_printed(beta):
    """(Murphy 1988, 2.8 and 2.9)."""
    zyx = representation("zyx-euler")
    for E in drawn(beta):
        sa, ca, sb, cb = math.sin(E[0]), math.cos(E[0]), math.sin(beta), math.cos(beta)
        B = [[0.0, -sa, ca * cb], [0.0, ca, sa * cb], [1.0, 0.0, -sb]]
        inverse = [[ca * sb / cb, sa * sb / cb, 1.0], [-sa, ca, 0.0], [ca / cb, sa / cb, 0.0]]
        for kernel, printed in ((zyx.angular_velocity, B), (zyx.rates, inverse)):
            found = np.array([kernel(zyx.chart_of(E), vector(unit)) for unit in np.eye(3)]).T
            np.testing.assert_allclose(found, printed, rtol=0.0, atol=TOLERANCE / cb)
