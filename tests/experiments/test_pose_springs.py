"""Springs of a pose beside what is not ours: gradients of potentials, the matrix logarithm, closed forms of ways."""

import functools

import numpy as np
import pytest
from scipy.linalg import expm, logm
from scipy.spatial.transform import Rotation

from bench.contenders.registry import known_pose_springs
from bench.experiments import pose_springs
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.law.scalar import KERNELS

SPRINGS = known_pose_springs()
AXES = Rotation.from_rotvec([0.3, -0.5, 0.7]).as_matrix()
K, KR = AXES @ np.diag([30.0, 10.0, 3.0]) @ AXES.T, 7.0
each = pytest.mark.parametrize("spring", SPRINGS.values(), ids=SPRINGS)
DRAWN = np.random.default_rng(3)
POSES = [(one, DRAWN.normal(size=3)) for one in Rotation.random(60, rng=DRAWN) if one.magnitude() < 3.0]


@functools.cache
def rows():
    return rows_of(Settings("quick"), Unit("pose-springs", count=1, total=1)).set_index("spring")


def stored(spring, turn, p):
    q = tuple(turn.as_quat(canonical=True, scalar_first=True).tolist())
    return spring.potential(q, tuple(p.tolist()), tuple(map(tuple, K.tolist())), KR)


def matrix(turn, p):
    X = np.eye(4)
    X[:3, :3], X[:3, 3] = turn.as_matrix(), p
    return X


@each
def test_functions_are_kernels_of_the_dialect(spring):
    assert spring.wrench in KERNELS
    assert spring.potential is None or spring.potential in KERNELS


@pytest.mark.parametrize("name", [name for name, spring in SPRINGS.items() if spring.potential])
def test_wrench_is_the_gradient_of_its_potential(name):
    spring, h = SPRINGS[name], 1e-5
    for turn, p in POSES:
        f, m = pose_springs.wrench(spring, turn, p, K, KR)
        for e in np.eye(3):
            ahead, behind = (stored(spring, turn, p + s * h * turn.apply(e)) for s in (1.0, -1.0))
            assert f @ e == pytest.approx((behind - ahead) / (2.0 * h), abs=1e-5)
            ahead, behind = (stored(spring, turn * Rotation.from_rotvec(s * h * e), p) for s in (1.0, -1.0))
            assert m @ e == pytest.approx((behind - ahead) / (2.0 * h), abs=1e-5)


def test_logarithm_of_the_pose_is_that_of_the_matrix():
    for turn, p in POSES:
        f, m = pose_springs.wrench(SPRINGS["log-pose"], turn, p, np.eye(3), 1.0)
        xi = logm(matrix(turn, p)).real
        np.testing.assert_allclose(-f, xi[:3, 3], atol=1e-9)
        np.testing.assert_allclose(-m, (xi[2, 1], xi[0, 2], xi[1, 0]), atol=1e-9)


def test_motion_of_the_logarithm_is_one_screw():
    """X(t) = exp(e^-t xi), by the matrix exponential; the origin's way is |rho| long."""
    turn, p = POSES[0]
    xi = logm(matrix(turn, p)).real
    turns, places = pose_springs.motion(SPRINGS["log-pose"], turn, p)
    for step in (1, 20, pose_springs.STEPS):
        X = expm(np.exp(-step * pose_springs.STEP) * xi)
        np.testing.assert_allclose(turns[step].as_matrix(), X[:3, :3], atol=1e-5)
        np.testing.assert_allclose(places[step], X[:3, 3], atol=1e-5)
    done = 1.0 - np.exp(-pose_springs.STEP * pose_springs.STEPS)
    assert pose_springs.length(places) == pytest.approx(done * np.linalg.norm(xi[:3, 3]), rel=5e-3)  # chords


@pytest.mark.parametrize("name", ["split", "split-tool", "geometric"])
def test_split_position_goes_straight(name):
    done = 1.0 - np.exp(-pose_springs.STEP * pose_springs.STEPS)
    assert rows().loc[name, ["way_median", "way_most"]].tolist() == pytest.approx([done, done], rel=1e-6)


def test_only_the_logarithm_of_the_pose_does_not_see_where_the_origin_is():
    assert rows().loc["log-pose", "apart_m"] < 1e-5
    assert (rows().drop("log-pose")["apart_m"] > 0.1).all()


@each
def test_work_is_zero_for_what_has_a_potential_and_no_one_else(spring):
    assert (rows().loc[spring.name, "work_share"] < 1e-13) == bool(spring.potential)


def test_logarithm_of_the_pose_is_no_spring_even_where_stiffness_is_the_same_about_all_axes():
    assert rows().loc["log-pose", "work_share_isotropic"] > 1e-3
    assert (rows().drop("log-pose")["work_share_isotropic"] < 1e-13).all()
