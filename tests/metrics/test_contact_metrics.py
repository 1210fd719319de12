"""Metrics of contact on records whose answers are known."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as Turn

import tasks
from bench.contenders.impedances import coordinates_relative, geometric
from bench.contenders.representations import zyx_euler
from bench.control.contact_controller import hybrid, impedance_controller
from bench.metrics.contact import held_axes, scene, stiffness, work, wrench
from bench.metrics.contact_metric import Pose, Response
from bench.metrics.measured_compliance import compliance, rotation_vector
from tasks.contact import Specification, Trial
from tasks.domains import crank, force_on_plane, peg_in_hole, surface_alignment, wrench_probe
from tasks.rotations import about, zyx

ARM = tasks.arm("ur5e")
CARTESIAN = hybrid("hybrid-base", "inverse")
SPRINGS = impedance_controller(geometric.IMPEDANCE)
TICKS = 101
TIME = np.linspace(0.0, 1.0, TICKS)
MOMENTS = 0.02 * np.vstack((np.eye(3), -np.eye(3)))


def specification(*held, desired_wrench=(0.0,) * 6) -> Specification:
    return Specification("as given", held, desired_wrench)


def trial(of: Specification, **more) -> Trial:
    return Trial("one", "pose", of, ARM.home, (1.0, 0.0, 0.0, 0.0), **more)


def answered(of: Trial, outcome="done", **arrays) -> Response:
    """A response that rests at the identity but for the arrays given."""
    still = np.zeros((TICKS, 3))
    blank = {
        "time": TIME,
        "R": np.tile(np.eye(3), (TICKS, 1, 1)),
        **dict.fromkeys(("omega", "p", "force", "moment"), still),
        **dict.fromkeys(("gap", "turned", "load"), np.zeros(TICKS)),
    }
    return Response(of, outcome, **(blank | arrays))


def pose(*responses, task=wrench_probe.TASK, controller=CARTESIAN) -> Pose:
    return Pose(task, ARM, controller, responses)


def spun(vector) -> np.ndarray:
    """Orientations that turn evenly by a rotation vector [rad]."""
    return Turn.from_rotvec(np.outer(TIME, vector)).as_matrix()


def yielding(C, *held, controller=CARTESIAN, outcome="done") -> Pose:
    """Six small moments on a hand whose rotation per moment is C."""
    return pose(
        *(
            answered(trial(specification(1, 1, 1, *held), push=(0.0, 0.0, 0.0, *m)), outcome, R=spun(C @ m))
            for m in MOMENTS.tolist()
        ),
        controller=controller,
    )


GENERAL = np.array([[0.3, 0.1, -0.2], [0.05, 0.5, 0.1], [0.2, -0.1, 0.4]])


def test_rotation_vector_is_scipys():
    turns = Turn.from_rotvec(np.random.default_rng(0).uniform(-1.5, 1.5, (50, 3)))
    np.testing.assert_allclose(rotation_vector(turns.as_matrix()), turns.as_rotvec(), atol=1e-14)


def test_rotation_vector_of_the_identity_is_zero():
    np.testing.assert_array_equal(rotation_vector(np.eye(3)), np.zeros(3))


def test_six_moments_give_back_the_rotation_per_moment():
    np.testing.assert_allclose(compliance(yielding(GENERAL, 0, 0, 1)), GENERAL, rtol=1e-10)


def test_what_grows_with_the_square_of_the_moment_cancels_between_opposites():
    ran = yielding(GENERAL, 0, 0, 1).responses
    bent = [one._replace(R=spun(rotation_vector(one.R[-1]) + np.array((1e-3, 0.0, 0.0)))) for one in ran]
    np.testing.assert_allclose(compliance(pose(*bent)), GENERAL, rtol=1e-10)


WHOLE = yielding(GENERAL, 0, 0, 1)


@pytest.mark.parametrize(
    "broken",
    [
        WHOLE._replace(responses=WHOLE.responses[:2]),
        yielding(GENERAL, 0, 0, 1, outcome="singular"),
        WHOLE._replace(task=surface_alignment.TASK),
    ],
    ids=["moments do not span space", "an episode broke off", "something else touches the hand"],
)
def test_nothing_is_yielded_where(broken):
    assert np.isnan(compliance(broken)).all()


def leaning(angle: float) -> np.ndarray:
    """A hand that complies about y, and about an axis that leans from x by an angle towards -z."""
    axes = np.array(((math.cos(angle), 0.0, -math.sin(angle)), (0.0, 1.0, 0.0)))
    return 0.08 * axes.T @ axes


LEANING = yielding(leaning(0.6), 0, 0, 1)
BACKWARDS = yielding(-0.1 * np.eye(3), 0, 0, 1)
DEAF = yielding(np.diag((0.0, 0.1, 0.0)), 0, 0, 1)
"""A moment about x turns nothing."""
COUPLED = yielding(np.array([[0.2, 0.1, 0.0], [0.1, 0.2, 0.0], [0.0, 0.0, 0.0]]), 0, 0, 1)
"""[[2, 1], [1, 2]] yields 1 to the moment about (1, -1): the least over all moments about axes that comply."""
HELD = yielding(GENERAL, 1, 1, 1)
OF_SPRINGS = yielding(np.diag((0.1, 0.2, 0.4)), 0, 1, 1, controller=SPRINGS)
"""An impedance complies about all axes whatever the order."""
SKEW = yielding(0.1 * np.array([[1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), 0, 0, 0)
"""Asymmetry is the skew part, 0.1 sqrt(2), over the symmetric one, 0.1 sqrt(3)."""
NONE = pytest.approx(math.nan, nan_ok=True)


@pytest.mark.parametrize(
    ("measure", "measured", "found"),
    [
        (stiffness.misalignment, LEANING, pytest.approx(0.6)),
        (stiffness.mean_misalignment, LEANING, pytest.approx(0.3)),
        (held_axes.leakage, LEANING, pytest.approx(math.tan(0.6))),
        (stiffness.misalignment, BACKWARDS, pytest.approx(math.pi)),
        (stiffness.misalignment, DEAF, NONE),
        (held_axes.leakage, DEAF, NONE),
        (stiffness.least_yield, DEAF, pytest.approx(0.0, abs=1e-15)),
        (stiffness.least_yield, COUPLED, pytest.approx(0.1)),
        (held_axes.leakage, HELD, NONE),
        (stiffness.misalignment, HELD, NONE),
        (stiffness.least_yield, HELD, NONE),
        (stiffness.stiffness_condition, HELD, NONE),
        (stiffness.stiffness_axes, HELD, NONE),
        (stiffness.stiffness_condition, OF_SPRINGS, pytest.approx(4.0)),
        (held_axes.leakage, OF_SPRINGS, NONE),
        (stiffness.stiffness_condition, yielding(GENERAL, 0, 1, 1), NONE),  # of one axis
        (stiffness.stiffness_asymmetry, yielding(GENERAL + GENERAL.T, 0, 0, 0), pytest.approx(0.0, abs=1e-12)),
        (stiffness.stiffness_asymmetry, SKEW, pytest.approx(math.sqrt(2.0 / 3.0))),
    ],
)
def test_measure_of_a_compliance_is_what_follows_from_it(measure, measured, found):
    assert measure(measured) == found


@pytest.mark.parametrize(
    ("yields", "angle", "found"),
    [
        ((0.1, 0.2, 0.3), 0.0, 0.0),
        ((0.1, 0.2, 0.3), 0.2, 0.2),
        ((0.1, 0.2, 0.3), 0.7, 0.7),
        ((0.1, 0.1, 0.3), 0.5, 0.0),
    ],
)
def test_principal_axes_are_those_that_the_stiffness_was_turned_to_and_any_where_it_is_equal(yields, angle, found):
    Q = Turn.from_rotvec((0.0, angle, 0.0) if len(set(yields)) == 3 else (0.0, 0.0, angle)).as_matrix()
    springs = yielding(Q @ np.diag(yields) @ Q.T, 0, 0, 0, controller=SPRINGS)
    assert stiffness.stiffness_axes(springs) == pytest.approx(found, abs=1e-7)


def moving(seed: int) -> dict:
    draw = np.random.default_rng(seed)
    return {
        "R": Turn.random(TICKS, rng=draw).as_matrix(),
        **{k: draw.normal(size=(TICKS, 3)) for k in ("omega", "moment")},
    }


EULER = zyx_euler.REPRESENTATION
CONVERTS, UNCONVERTED = hybrid("hybrid", "inverse", EULER), hybrid("hybrid-unconverted", "inverse", EULER)
ABOUT_XY = trial(specification(1, 1, 1, 0, 0, 1))


@pytest.mark.parametrize(
    ("controller", "least", "most"),
    [
        (CONVERTS, 0.0, 1e-13),
        (impedance_controller(coordinates_relative.IMPEDANCE, EULER), 0.0, 1e-13),
        (UNCONVERTED, 0.1, math.inf),
    ],
)
def test_work_is_conserved_to_rounding_in_coordinates_that_convert_and_not_otherwise(controller, least, most):
    assert least < work.work_residual(pose(answered(ABOUT_XY, **moving(1)), controller=controller)) < most


def test_work_has_no_residual_without_coordinates_or_without_motion():
    for controller in (CARTESIAN, CONVERTS):
        assert math.isnan(work.work_residual(pose(answered(ABOUT_XY), controller=controller)))


PRESSING = specification(1, 1, 0, 0, 0, 1, desired_wrench=(0.0, 0.0, -20.0, 0.0, 0.0, 0.0))
FROM = 40
"""Tick of the first touch in what follows."""


def pressed(force, moment=(0.0, 0.0, 0.0), task=surface_alignment.TASK, **more) -> Pose:
    """Nothing before the first touch, then a constant force and moment, or those of every tick."""
    felt = np.zeros((2, TICKS, 3))
    felt[0, FROM:], felt[1, FROM:] = force, moment
    return pose(answered(trial(PRESSING, **more), force=felt[0], moment=felt[1]), task=task)


TOUCHING = pressed((3.0, -4.0, 17.0), (0.3, 0.4, 9.0))
"""3 N and 0.5 N m are missing along and about the axes that comply."""
RAMP = pressed(np.linspace((0.0, 0.0, 10.0), (0.0, 0.0, 20.0), TICKS - FROM))
NO_TOUCH = pressed((0.0, 0.0, 0.0))
ONCE_OUTSIDE = np.tile((0.0, 0.0, 20.3), (TICKS - FROM, 1))
ONCE_OUTSIDE[10] = (0.0, 0.0, 20.5)  # 2.5 %


@pytest.mark.parametrize(
    ("measure", "measured", "found"),
    [
        (wrench.force_error_rms, TOUCHING, 3.0),
        (wrench.force_error_peak, TOUCHING, 3.0),
        (wrench.moment_error_rms, TOUCHING, 0.5),
        (wrench.moment_error_peak, TOUCHING, 0.5),
        (wrench.force_error_peak, RAMP, 10.0),  # counted from the first touch on
        *(
            (measure, NO_TOUCH, math.nan)
            for measure in (wrench.force_error_rms, wrench.moment_error_peak, wrench.normal_force_error)
        ),
        # settling: from the touch to the last tick outside the band
        (wrench.contact_settling_time, NO_TOUCH, math.nan),
        (wrench.contact_settling_time, pressed(ONCE_OUTSIDE), 0.11),
        (wrench.contact_settling_time, pressed((0.0, 0.0, 19.9)), 0.0),
        (wrench.contact_settling_time, pressed((0.0, 0.0, 19.0)), math.nan),
    ],
)
def test_errors_and_settling_are_of_what_is_felt_from_the_first_touch_on(measure, measured, found):
    assert measure(measured) == pytest.approx(found, nan_ok=True)


def test_a_tool_flat_on_a_plate_has_no_alignment_error():
    """The wrist's axis points down; how the hand's frame is drawn on it does not matter."""
    mount = zyx(0.3, -0.8, 1.1)
    wrist = Turn.from_rotvec((math.pi - 0.2, 0.0, 0.0))
    drawn = (wrist * Turn.from_quat(mount, scalar_first=True)).as_matrix()
    flat = answered(
        trial(PRESSING, mount_wxyz=mount, scene_wxyz=about((1.0, 0.0, 0.0), -0.2)), R=np.tile(drawn, (TICKS, 1, 1))
    )
    assert scene.alignment_error(pose(flat, task=surface_alignment.TASK)) == pytest.approx(0.0, abs=1e-12)
    askew = flat._replace(trial=flat.trial._replace(scene_wxyz=about((1.0, 0.0, 0.0), 0.1)))
    assert scene.alignment_error(pose(askew, task=surface_alignment.TASK)) == pytest.approx(0.3)


def test_normal_force_error_is_along_the_normal_of_the_plane():
    """A plane that leans by 30 degrees: a force along it is no error."""
    plane = about((0.0, 1.0, 0.0), math.radians(30.0))
    normal, along = np.array((0.5, 0.0, math.sqrt(0.75))), np.array((math.sqrt(0.75), 0.0, -0.5))
    measured = pressed(
        (20.0 * math.sqrt(0.75) + 2.0) * normal + 7.0 * along, task=force_on_plane.TASK, scene_wxyz=plane
    )
    assert wrench.normal_force_error(measured) == pytest.approx(2.0)


def test_peaks_are_the_largest_of_all_ticks_and_trials():
    quiet, loud = (np.tile(vector, (TICKS, 1)) for vector in ((1.0, 2.0, 2.0), (0.0, 3.0, 4.0)))
    load, gap = np.linspace(0.1, 0.7, TICKS), np.linspace(0.0, -2e-3, TICKS)
    both = pose(
        answered(trial(PRESSING), force=loud, moment=quiet, load=load),
        answered(trial(PRESSING), force=quiet, moment=loud, gap=gap),
    )
    assert wrench.peak_force(both) == wrench.peak_moment(both) == 5.0
    assert wrench.peak_torque_ratio(both) == 0.7
    assert scene.penetration(both) == 2e-3


def test_nothing_penetrates_that_does_not_touch():
    assert math.isnan(scene.penetration(pose(answered(trial(PRESSING)))))


HOLE = {"scene_pos": (0.4, 0.1, 0.2), "scene_wxyz": about((1.0, 0.0, 0.0), 0.1)}
INTO = -np.array((0.0, -math.sin(0.1), math.cos(0.1)))


def inserted(depths, beside=0.0) -> Pose:
    """A tip that goes down the axis of a leaning hole, or of its rim, to depths [m]."""
    p = np.array(HOLE["scene_pos"]) + np.outer(depths, INTO) + np.array((beside, 0.0, 0.0))
    return pose(answered(trial(PRESSING, **HOLE), p=p), task=peg_in_hole.TASK)


@pytest.mark.parametrize(
    ("depths", "beside", "depth", "is_stuck"),
    [
        (np.linspace(-0.002, peg_in_hole.DEPTH, TICKS), 0.0, peg_in_hole.DEPTH, 0.0),
        (np.minimum(np.linspace(0.0, 0.03, TICKS), 0.015), 0.0, 0.015, 1.0),
        (np.linspace(0.0, 0.02, TICKS), 0.0, 0.02, 1.0),
        (np.full(TICKS, 0.03), 2.0 * peg_in_hole.HOLE, 0.0, 1.0),
    ],
    ids=["at the bottom", "stands halfway", "creeps", "beside the hole"],
)
def test_depth_of_a_peg_and_whether_it_is_stuck(depths, beside, depth, is_stuck):
    measured = inserted(depths, beside)
    assert scene.insertion_depth(measured) == pytest.approx(depth)
    assert scene.jam(measured) == is_stuck


CRANKED = answered(trial(specification(1, 0, 0, 0, 0, 1)), turned=np.linspace(0.2, 0.9, TICKS))
LEFT = answered(ABOUT_XY._replace(legs=((0.0,) * 6,) * 4), R=spun((0.03, 0.0, -0.04)))
"""What a loop of moments leaves."""
PUSHED = answered(ABOUT_XY, R=spun((0.0, 0.0, 0.1)))
"""A push is no loop."""
TURNED = answered(trial(PRESSING), R=spun((0.3, 0.1, 0.02)))


@pytest.mark.parametrize(
    ("measure", "measured", "found"),
    [
        (scene.crank_angle, pose(CRANKED, task=crank.TASK), 0.7),
        (scene.crank_angle, pose(CRANKED), math.nan),
        (held_axes.loop_rest, pose(LEFT), 0.05),
        (held_axes.loop_drift, pose(LEFT), 0.04),  # its part about held axes
        (held_axes.loop_rest, pose(PUSHED), math.nan),
        (held_axes.loop_drift, pose(PUSHED), math.nan),
        (held_axes.held_turn, pose(TURNED, task=surface_alignment.TASK), 0.02),  # about held axes alone
    ],
)
def test_turn_that_is_left_is_that_of_the_crank_the_loop_or_the_held_axes(measure, measured, found):
    assert measure(measured) == pytest.approx(found, nan_ok=True)
