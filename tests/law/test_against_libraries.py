"""The error vector of every law against an implementation that is not ours: drawn, near half turns and exactly on them.

The turns are those that libraries are asked at in results/libraries, their axis and angle known to 60 digits. A law is
called at rest with a goal that permutes the axes and R = T^T R_d, which is exact: the turn T that leads from R to R_d
is then the very matrix, bit for bit, that the library is given.

Of an exact half turn both directions are right, and libraries differ in which they take; beside that nothing is free.
"""

import functools
import itertools
import math

import mujoco
import numpy as np
import pinocchio
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.states import as_rotation, axis_permuting, matrix, vector

from bench.law.contenders.registry import find_contender
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.studies.libraries import turns
from bench.studies.libraries.asked import find
from bench.studies.libraries.asked.simulators import load_model, place_body
from bench.studies.libraries.library import MATRIX

GAINS = Tuning(kp=100.0, kv=20.0)
# A dozen roundings of numbers up to pi on either side; most differences are below 5 EPS.
TOLERANCE = 20 * EPS
REGULAR = 0.05  # cos(beta) above which B^-1 is at most 20 times larger than 1

SETS = {
    "drawn": lambda: turns.drawn().turns[:200],
    "small": lambda: [one for decade in range(1, 9) for one in turns.small(decade).turns[::9]],
    "near": lambda: [one for decade in range(1, 13) for one in turns.near_half_turn(decade).turns[::3]],
    "exact": lambda: turns.half_turns().turns,
}


@functools.cache
def judged(word):
    """The turns of a set."""
    return tuple(SETS[word]())


def error(law, T, R_d=None):
    """e(R, R_d) = u/Kp at rest, on the first tick, of R = T^T R_d."""
    one = find_contender(law)
    R_d = as_rotation(np.eye(3)) if R_d is None else R_d
    R = as_rotation((T.T @ matrix(R_d)).T)
    memory = () if one.regulator.memory is None else (one.regulator.memory,)
    with np.errstate(all="ignore"):
        u = one.law(R, vector(AT_REST), Goal(R_d), GAINS, *memory)
    return np.array(u[0] if memory else u) / GAINS.kp


def errors(law, some):
    """e of every turn, the 24 goals in turn."""
    return np.array([error(law, turn.R, R_d) for turn, R_d in zip(some, itertools.cycle(axis_permuting()))])


def scales(some):
    """What a difference is measured in: 1, or the angle where it is smaller."""
    return np.array([min(1.0, turn.angle) for turn in some])


def assert_agree(ours, theirs, scale, where="", tolerance=TOLERANCE):
    """Every difference is within tolerance x scale; on exact half turns in one of the two directions."""
    if where == "exact":
        theirs = theirs * np.sign(np.sum(ours * theirs, axis=1, keepdims=True))
    gaps = np.abs(ours - theirs).max(axis=1) / scale
    worst = int(np.argmax(gaps))
    assert gaps[worst] <= tolerance, (gaps[worst], worst, ours[worst], theirs[worst])


def asked(library, name):
    """Return one function, from a turn to an error; the libraries are imported when it is first called."""

    def called(turn):
        functions = {(one.name, each.name): each for one in find().libraries for each in one.functions}
        found = functions[library, name]
        return np.array(found.call(turn.R if found.takes == MATRIX else turn.quat_wxyz))

    return called


def shortest(of_turn):
    """2 sgn(w) (x, y, z) from a function that gives (w, x, y, z)."""

    def called(turn):
        quat_wxyz = np.array(of_turn(turn))
        return 2.0 * math.copysign(1.0, quat_wxyz[0]) * quat_wxyz[1:]

    return called


def braking_late(double):
    """(1 + cos(theta/2)^2) sin(theta/2) k from a function that gives 2 sin(theta/2) k."""

    def called(turn):
        eps = 0.5 * double(turn)
        return (2.0 - eps @ eps) * eps

    return called


def mujocos_quaternion(turn):
    quat_wxyz = np.empty(4)
    mujoco.mju_mat2Quat(quat_wxyz, turn.R.ravel())
    return quat_wxyz


ROTATION_VECTORS = {
    "scipy": asked("scipy", "as_rotvec, of a matrix"),
    "mju_subQuat": asked("mujoco", "mju_subQuat"),
    "mju_quat2Vel": asked("mujoco", "mju_mat2Quat, mju_quat2Vel"),
    "orientation-actuator": asked("mujoco", "<orientation> actuator"),
    "log3-of-quaternion": asked("pinocchio", "log3, of a quaternion"),
    "mink": asked("mink", "se3_log (compiled), of a matrix"),
    "mink-frame-task": asked("mink", "FrameTask.compute_error"),
}
QUATERNIONS = {
    "scipy": shortest(lambda turn: ScipyRotation.from_matrix(turn.R).as_quat(scalar_first=True)),
    "mju_mat2Quat": shortest(mujocos_quaternion),
    "pinocchio": shortest(lambda turn: pinocchio.Quaternion(turn.R).coeffs()[[3, 0, 1, 2]]),
}
MRPS = {"scipy": asked("scipy", "4 as_mrp")}
FAR_SHEET = {"scipy": lambda turn: 2.0 * ScipyRotation.from_quat(-turn.quat_wxyz, scalar_first=True).as_quat()[:3]}
ORACLES = {
    **dict.fromkeys(
        (
            "rotation-vector",
            "rotation-vector-memory",
            "braking-cascade",
            "braking-cascade-memory",
            "braking-feedforward",
        ),
        ROTATION_VECTORS,
    ),
    **dict.fromkeys(
        (
            "quaternion-shortest",
            "square-root",
            "hybrid",
            "sliding",
            "sliding-memory",
            "mrp-linearized",
            "wie-bailey-heiberg",
            "wie-bailey-heiberg-memory",
        ),
        QUATERNIONS,
    ),
    **dict.fromkeys(("mrp", "mrp-memory"), MRPS),
    "quaternion-unwinding": FAR_SHEET,
    "in-engine": {"orientation-actuator": ROTATION_VECTORS["orientation-actuator"]},
    "late-braking": {name: braking_late(oracle) for name, oracle in QUATERNIONS.items()},
}
PAIRS = [(law, oracle) for law, oracles in ORACLES.items() for oracle in oracles]


@pytest.mark.parametrize("where", SETS)
@pytest.mark.parametrize(("law", "oracle"), PAIRS)
def test_error_is_the_librarys(law, oracle, where):
    some = judged(where)
    theirs = np.array([ORACLES[law][oracle](turn) for turn in some])
    assert_agree(errors(law, some), theirs, scales(some), where)


@pytest.mark.parametrize("where", SETS)
def test_rotation_vector_is_pinocchios_logarithm_of_the_matrix(where):
    """log3 divides by sin(theta) until 0.01 rad from the half turn, where it has lost four digits; one near 0."""
    some = judged(where)
    theirs = np.array([pinocchio.log3(turn.R) for turn in some])
    lost = np.array([10.0 / min(1.0, max(math.pi - turn.angle, 0.01)) ** 2 for turn in some])
    assert_agree(errors("rotation-vector", some), theirs, lost * scales(some), where)


@pytest.mark.parametrize("where", ["drawn", "small", "near"])
@pytest.mark.parametrize("law", ["gibbs", "paielli-bach"])
def test_tangent_of_half_the_angle_is_that_of_scipys_mrp(law, where):
    """2 tan(theta/2) = 4 s/(1 - s^2), s = tan(theta/4), down to where 1 + t = 4 cos(theta/2)^2 is rounding alone."""
    some = [turn for turn in judged(where) if turn.quat_wxyz[0] ** 2 > 1e4 * EPS]
    assert len(some) >= len(judged(where)) // 3
    sigma = ScipyRotation.from_matrix([turn.R for turn in some]).as_mrp()
    theirs = 4.0 * sigma / (1.0 - np.sum(sigma**2, axis=1, keepdims=True))
    # relative: 1 + t and 1 - s^2 are rounded as numbers near 1
    lost = np.linalg.norm(theirs, axis=1) / np.array([turn.quat_wxyz[0] ** 2 for turn in some])
    assert_agree(errors(law, some), theirs, lost)


@pytest.mark.parametrize("law", ["gibbs", "paielli-bach"])
def test_tangent_of_a_right_angle_is_no_number_or_by_rounding_nought(law):
    """s = 0 exactly over 1 + t, which is 0 or a unit in its last place: no command, or none that helps."""
    found = errors(law, judged("exact"))
    nought = (found == 0.0).all(axis=1)
    assert (nought | ~np.isfinite(found).any(axis=1)).all()
    assert nought.sum() < len(found) / 2


@pytest.mark.parametrize("where", SETS)
def test_rotation_matrix_error_is_a_welds_residual_through_its_jacobian(where):
    """4 J^T r is sin(theta) k: where a weld pulls whose impedance is near zero; the default weld pulls otherwise."""

    def pull(turn):
        data = place_body("welded", np.array(turn.quat_wxyz))
        return 4.0 * data.efc_J.reshape(-1, load_model("welded")[0].nv)[3:6].T @ data.efc_pos[3:6]

    some = judged(where)
    assert_agree(errors("rotation-matrix", some), np.array([pull(turn) for turn in some]), scales(some))


@pytest.mark.parametrize("where", SETS)
def test_weighted_columns_error_is_of_numpys_cross_products_of_mujocos_columns(where):
    some = judged(where)
    theirs, columns = [], np.empty(9)
    for turn, R_d in zip(some, itertools.cycle(axis_permuting())):
        mujoco.mju_quat2Mat(columns, turn.quat_wxyz)
        R = columns.reshape(3, 3).T @ matrix(R_d)
        theirs.append(0.5 * np.array((0.8, 1.0, 1.2)) @ np.cross(R.T, matrix(R_d).T))
    assert_agree(errors("weighted-columns", some), np.array(theirs), scales(some))


@pytest.mark.parametrize("where", SETS)
def test_euler_gradient_is_pinocchios_jacobian_times_the_difference_of_angles(where):
    """B is computeRpyJacobian in the base frame; away from the pole, and from where an angle is pi or -pi."""
    found = []
    for turn in judged(where):
        rpy = pinocchio.rpy.matrixToRpy(turn.R.T)
        if math.cos(rpy[1]) > REGULAR and math.pi - np.abs(rpy).max() > 1e-6:
            B = pinocchio.rpy.computeRpyJacobian(rpy, pinocchio.WORLD)
            found.append((error("euler-gradient", turn.R), B @ -rpy))
    assert len(found) >= len(judged(where)) // 4
    ours, theirs = np.swapaxes(found, 0, 1)
    assert_agree(ours, theirs, 1.0 / REGULAR)


def test_feedback_linearized_is_pinocchios_jacobian_and_its_derivative():
    """u = B (Kp (E_d - E) - Kd Edot) + Bdot Edot (Murphy 1988, 2.15), with a goal and a rate."""
    law, draw = find_contender("feedback-linearized/zyx-euler").law, np.random.default_rng(1)
    found, scale = [], []
    for turn, aim in zip(judged("drawn"), judged("drawn")[::-1], strict=True):
        omega = draw.normal(scale=5.0, size=3)
        rpy, rpy_d = pinocchio.rpy.matrixToRpy(turn.R), pinocchio.rpy.matrixToRpy(aim.R)
        if math.cos(rpy[1]) > REGULAR:
            B = pinocchio.rpy.computeRpyJacobian(rpy, pinocchio.WORLD)
            Edot = pinocchio.rpy.computeRpyJacobianInverse(rpy, pinocchio.WORLD) @ omega
            Bdot = pinocchio.rpy.computeRpyJacobianTimeDerivative(rpy, Edot, pinocchio.WORLD)
            u_E = GAINS.kp * (rpy_d - rpy) - GAINS.kv * Edot
            ours = law(as_rotation(turn.R.T), vector(omega), Goal(as_rotation(aim.R.T)), GAINS)
            found.append((np.array(ours), B @ u_E + Bdot @ Edot))
            scale.append((np.abs(u_E).max() + Edot @ Edot) / math.cos(rpy[1]) ** 2)
    assert len(found) > 150
    ours, theirs = np.swapaxes(found, 0, 1)
    assert_agree(ours, theirs, np.array(scale))
