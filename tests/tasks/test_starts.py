"""Start sets and random starts: that each has what it says, exactly where a double can be exact."""

import math
import re

import numpy as np
import pytest
from scipy import stats
from scipy.stats import qmc
from support.states import rotation

import tasks
from tasks.base import AT_REST, IDENTITY, Start, angle
from tasks.haar import orientation
from tasks.random_starts import BLOCK, block
from tasks.rotations import columns

NAMES = tasks.start_set_names()
DIRECTED = ("paper", "half-turn", "poles", "wraps", "box")


def rotations(starts):
    return rotation([start.quat_wxyz for start in starts])


def euler_angles(starts):
    """alpha, beta, gamma from the matrix, by definition: R = Rz(alpha) Ry(beta) Rx(gamma)."""
    R = rotations(starts).as_matrix()
    beta = np.arctan2(-R[:, 2, 0], np.hypot(R[:, 0, 0], R[:, 1, 0]))
    return np.arctan2(R[:, 1, 0], R[:, 0, 0]), beta, np.arctan2(R[:, 2, 1], R[:, 2, 2])


def chosen(name, pattern):
    found = [start for start in tasks.start_set(name) if re.search(pattern, start.id)]
    assert found
    return found


@pytest.mark.parametrize("seed", [0, 7])
@pytest.mark.parametrize("name", NAMES)
def test_stretch_is_that_of_the_whole_set(name, seed):
    whole = tasks.start_set(name, 2000, seed)
    for first, end in ((0, 1), (0, 30), (17, 18), (20, 1100), (1100, 1537), (1999, 2000)):
        assert tasks.starts_between(name, first, end, seed) == whole[first:end]


def test_uniform_points_are_those_of_one_long_draw():
    points = qmc.Halton(d=3, scramble=True, rng=3).random(100_050)[100_000:].tolist()
    made = tasks.starts_between("uniform", 100_000, 100_050, 3)
    assert made == [Start(f"uniform-{i}", orientation(*point)) for i, point in enumerate(points, 100_000)]


def test_goals_are_the_far_ones_of_one_long_draw():
    points = qmc.Halton(d=6, scramble=True, rng=3).random(6000).tolist()
    pairs = [(orientation(*point[:3]), orientation(*point[3:])) for point in points]
    far = [pair for pair in pairs if angle(pair[1], IDENTITY) > math.pi / 2]
    made = [start for start in tasks.start_set("goals", 4000, 3) if start.id.startswith("goal-uniform")]
    assert [(start.quat_wxyz, start.goal_wxyz) for start in made] == far[: len(made)]


@pytest.mark.parametrize("name", NAMES)
def test_length_is_known_without_the_starts(name):
    for count in (None, 1, 5, 300):
        assert tasks.start_set_length(name, count) == len(tasks.start_set(name, count))


@pytest.mark.parametrize("name", DIRECTED)
def test_directed_set_ends_at_its_own_number(name):
    assert tasks.start_set(name, 10**6) == tasks.start_set(name)
    assert len(tasks.start_set(name)) <= 250


@pytest.mark.parametrize("name", [name for name in NAMES if name not in ("goals", "tumbling")])
def test_start_is_at_rest_with_identity_as_goal(name):
    assert all(start.omega == AT_REST and start.goal_wxyz == IDENTITY for start in tasks.start_set(name))


DRAWN = [block(number, seed=5, most_speed=20.0) for number in (0, 1, 2**31)]
QUATS, OMEGAS = map(np.concatenate, zip(*DRAWN, strict=True))
UNLIKELY = 1.627 / math.sqrt(len(QUATS))
"""Kolmogorov's statistic of independent draws exceeds it with a probability of 0.01."""


@pytest.mark.parametrize("seed", [*range(4), None])
def test_uniform_starts_and_random_ones_have_the_haar_measure(seed):
    """Low-discrepancy points deviate less than 5,000 independent ones, whose standard errors are about 0.01."""
    quats = QUATS if seed is None else [start.quat_wxyz for start in tasks.start_set("uniform", seed=seed)]
    np.testing.assert_allclose(np.linalg.norm(quats, axis=1), 1.0, atol=4e-16)
    found, (most, of_elements) = rotation(quats), (UNLIKELY, UNLIKELY) if seed is None else (0.01, 0.015)
    assert stats.kstest(found.magnitude(), lambda theta: (theta - np.sin(theta)) / math.pi).statistic < most
    for element in found.as_matrix().reshape(-1, 9).T:  # Archimedes
        assert stats.kstest(element, stats.uniform(-1.0, 2.0).cdf).statistic < of_elements


@pytest.mark.parametrize("most", [0.03, UNLIKELY])
def test_speeds_and_directions_of_tumbling_starts_and_of_random_ones_are_uniform(most):
    omega = OMEGAS if most == UNLIKELY else np.array([start.omega for start in tasks.start_set("tumbling")])
    speeds = np.linalg.norm(omega, axis=1)
    assert stats.kstest(speeds, stats.uniform(0.0, 20.0).cdf).statistic < most
    for z in (omega / speeds[:, None]).T:
        assert stats.kstest(z, stats.uniform(-1.0, 2.0).cdf).statistic < most


def test_half_turn_angles_are_pi_minus_powers_of_ten_or_exactly_pi():
    for start in chosen("half-turn", "exact$"):
        assert (start.quat_wxyz[0], angle(start.quat_wxyz, IDENTITY)) == (0.0, math.pi)
    for k in range(13):
        for start in chosen("half-turn", f"k{k:02d}$"):
            assert angle(start.quat_wxyz, IDENTITY) == pytest.approx(math.pi - 10.0**-k, abs=1e-15)
            # 2 |w| = 2 sin(delta/2), within delta^2/24 of delta
            assert 2 * start.quat_wxyz[0] == pytest.approx(2 * math.sin(10.0**-k / 2), rel=1e-15)


def test_half_turn_has_axes_of_every_kind_at_every_distance():
    exact = {start.id.removesuffix("-exact") for start in chosen("half-turn", "exact$")}
    assert {"half-turn-x", "half-turn-y", "half-turn-z", "half-turn-x-z", "half-turn-xyz"} < exact
    assert sum("random" in word for word in exact) == 4
    for k in range(13):
        assert {start.id.removesuffix(f"-k{k:02d}") for start in chosen("half-turn", f"k{k:02d}$")} == exact


def test_poles_are_exact_when_said_so():
    exact = [(start.quat_wxyz, "pole-plus" in start.id) for start in chosen("poles", "exact")]
    exact += [(start.goal_wxyz, "pole-plus" in start.id) for start in chosen("goals", "goal-pole")]
    for quat, is_plus in exact:
        n = columns(quat)[0]
        assert n[:2] == (0.0, 0.0)
        assert abs(n[2] + (1 if is_plus else -1)) <= 2**-52


@pytest.mark.parametrize(("pole", "sign"), [("plus", 1), ("minus", -1)])
def test_poles_are_a_power_of_ten_away_when_not_exact(pole, sign):
    for k in range(1, 13):
        starts = chosen("poles", f"pole-{pole}-k{k:02d}")
        beta = euler_angles(starts)[1]
        # n_x and n_y round to about 2e-16
        np.testing.assert_allclose(math.pi / 2 - sign * beta, 10.0**-k, rtol=1e-9, atol=5e-16)
    alpha, _, gamma = euler_angles(chosen("poles", f"pole-{pole}-k01-a1.0-g-0.5$"))
    np.testing.assert_allclose([*alpha, *gamma], [1.0, -0.5], atol=1e-13)


@pytest.mark.parametrize(("name", "zero", "negative"), [("alpha", (0, 1), (0, 0)), ("gamma", (1, 2), (2, 2))])
def test_wraps_are_exact_when_said_so(name, zero, negative):
    for start in chosen("wraps", f"wrap-{name}-exact"):
        R = columns(start.quat_wxyz)
        assert R[zero[0]][zero[1]] == 0.0 > R[negative[0]][negative[1]]


@pytest.mark.parametrize(("word", "sign"), [("plus", 1), ("minus", -1)])
@pytest.mark.parametrize(("name", "index"), [("alpha", 0), ("gamma", 2)])
def test_wraps_are_a_power_of_ten_away_when_not_exact(name, index, word, sign):
    for k in range(1, 13):
        value = euler_angles(chosen("wraps", f"wrap-{name}-{word}-k{k:02d}"))[index]
        np.testing.assert_allclose(sign * value, math.pi - 10.0**-k, rtol=0, atol=1e-15)


def test_box_grid_and_inside_are_inside_and_outside_is_outside():
    inside = np.abs(euler_angles(chosen("box", "grid|inside")))
    assert (inside.max(axis=1) < (math.pi / 2, math.pi / 2, math.pi)).all()
    alpha, _, _ = euler_angles(chosen("box", "outside"))
    assert np.abs(alpha).min() > math.pi / 2
    assert set(np.sign(alpha)) == {-1.0, 1.0}


def test_box_inside_reaches_every_face_edge_and_corner():
    for depth in ("0.1", "0.001"):
        alpha, beta, gamma = euler_angles(chosen("box", f"inside-...-{depth}$"))
        near = np.stack(
            [
                np.sign(value) * (np.abs(value) > width - float(depth) - 1e-9)
                for value, width in ((alpha, math.pi / 2), (beta, math.pi / 2), (gamma, math.pi))
            ],
            axis=1,
        )
        assert len({tuple(row) for row in near.tolist()}) == 26


def test_box_on_is_on_the_boundary():
    for start in chosen("box", "box-on-"):
        n, _, a = columns(start.quat_wxyz)
        # alpha = +-pi/2 or a pole: n_x = 0; gamma = +-pi: o_z = 0 and a_z < 0
        assert abs(n[0]) < 4e-16 or a[2] < 0.0


def test_goals_are_far_from_identity():
    uniform = chosen("goals", "uniform")
    assert min(angle(start.goal_wxyz, IDENTITY) for start in uniform) > math.pi / 2
    assert all(start.goal_wxyz != IDENTITY for start in tasks.start_set("goals"))


@pytest.mark.parametrize(
    ("pattern", "way", "rounding"),
    [("goal-beyond-wrap", 0.4, 1e-14), ("start-half-turn", math.pi, 1e-15), ("at-goal$", 0.0, 1e-15)],
)
def test_goals_are_as_far_as_said(pattern, way, rounding):
    for start in chosen("goals", pattern):
        assert angle(start.quat_wxyz, start.goal_wxyz) == pytest.approx(way, abs=rounding)


def test_paper_has_one_start_per_figure_away_from_every_failure():
    starts = tasks.start_set("paper")
    assert [start.id for start in starts] == ["figure-2.3", "figure-2.4", "figure-2.5"]
    assert all(abs(beta) < math.radians(70) for beta in euler_angles(starts)[1])
    assert rotations(starts).magnitude().max() < math.radians(175)


def test_block_follows_from_its_number_and_seed():
    quats, omegas = block(7, seed=3)
    assert quats.shape == (BLOCK, 4)
    assert not omegas.any()
    np.testing.assert_array_equal(block(7, seed=3, most_speed=1.0)[0], quats)
    for other in (block(8, seed=3), block(7, seed=4)):
        assert not np.isin(other[0], quats).any()
