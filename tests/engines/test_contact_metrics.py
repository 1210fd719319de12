"""Metrics of contact on records whose answers are known; what a file of metrics must hold."""

import importlib
import math
import sys

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.contact_records import CARTESIAN, TICKS, answered, pose, specification, spun, trial

from bench.base.errors import BadMetric
from bench.engines.metrics import registry
from bench.engines.metrics.contact import held_axes, scene, work, wrench
from bench.engines.metrics.contact_metric import Pose
from bench.engines.metrics.metric import Metric
from bench.law.contenders.impedances import coordinates_relative
from bench.law.contenders.representations import zyx_euler
from bench.law.control.contact_controller import hybrid, impedance_controller
from tasks.domains import crank, force_on_plane, peg_in_hole, surface_alignment
from tasks.rotations import about, zyx


def moving(seed: int) -> dict:
    draw = np.random.default_rng(seed)
    return {
        "R": ScipyRotation.random(TICKS, rng=draw).as_matrix(),
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


def test_a_tool_flat_on_a_plate_has_no_alignment_error():
    """The wrist's axis points down; how the hand's frame is drawn on it does not matter."""
    mount = zyx(0.3, -0.8, 1.1)
    wrist = ScipyRotation.from_rotvec((math.pi - 0.2, 0.0, 0.0))
    drawn = (wrist * ScipyRotation.from_quat(mount, scalar_first=True)).as_matrix()
    flat = answered(
        trial(PRESSING, mount_wxyz=mount, scene_wxyz=about((1.0, 0.0, 0.0), -0.2)), R=np.tile(drawn, (TICKS, 1, 1))
    )
    assert scene.alignment_error(pose(flat, task=surface_alignment.TASK)) == pytest.approx(0.0, abs=1e-12)
    askew = flat._replace(trial=flat.trial._replace(scene_wxyz=about((1.0, 0.0, 0.0), 0.1)))
    assert scene.alignment_error(pose(askew, task=surface_alignment.TASK)) == pytest.approx(0.3)


LEANS = {"task": force_on_plane.TASK, "scene_wxyz": about((0.0, 1.0, 0.0), math.radians(30.0))}
NORMAL, ALONG = np.array((0.5, 0.0, math.sqrt(0.75))), np.array((math.sqrt(0.75), 0.0, -0.5))
"""Normal of a plane that leans by 30 degrees; a force along it is no error."""
ON_SLOPE = pressed((20.0 * math.sqrt(0.75) + 2.0) * NORMAL + 7.0 * ALONG, **LEANS)


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
        (wrench.force_error_rms, TOUCHING, 3.0),
        (wrench.force_error_peak, TOUCHING, 3.0),
        (wrench.moment_error_rms, TOUCHING, 0.5),
        (wrench.moment_error_peak, TOUCHING, 0.5),
        (wrench.force_error_peak, RAMP, 10.0),  # counted from the first touch on
        *(
            (measure, NO_TOUCH, math.nan)
            for measure in (wrench.force_error_rms, wrench.moment_error_peak, wrench.normal_force_error)
        ),
        (wrench.normal_force_error, ON_SLOPE, 2.0),
        (scene.penetration, pose(answered(trial(PRESSING))), math.nan),  # nothing touches
        # settling: from the touch to the last tick outside the band
        (wrench.contact_settling_time, NO_TOUCH, math.nan),
        (wrench.contact_settling_time, pressed(ONCE_OUTSIDE), 0.11),
        (wrench.contact_settling_time, pressed((0.0, 0.0, 19.9)), 0.0),
        (wrench.contact_settling_time, pressed((0.0, 0.0, 19.0)), math.nan),
        (scene.crank_angle, pose(CRANKED, task=crank.TASK), 0.7),
        (scene.crank_angle, pose(CRANKED), math.nan),
        (held_axes.loop_rest, pose(LEFT), 0.05),
        (held_axes.loop_drift, pose(LEFT), 0.04),  # its part about held axes
        (held_axes.loop_rest, pose(PUSHED), math.nan),
        (held_axes.loop_drift, pose(PUSHED), math.nan),
        (held_axes.held_turn, pose(TURNED, task=surface_alignment.TASK), 0.02),  # about held axes alone
    ],
)
def test_measure_of_a_record_is_what_was_put_into_it(measure, measured, found):
    assert measure(measured) == pytest.approx(found, nan_ok=True)


ONE = """
from bench.engines.metrics.metric import Metric, as_it_is

def update(value, sample):
    return value

"""
FIRST = 'METRIC = Metric("zeta", "1", "first", 0.0, update, as_it_is)'
PAIR = """METRICS = (
    Metric("{column}", "1", "second", 0.0, update, as_it_is),
    Metric("beta", "1", "third", 0.0, update, as_it_is),
)"""


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package of metrics that are in the files given."""
    monkeypatch.syspath_prepend(tmp_path)

    def of(**files: str):
        folder = tmp_path / "some_metrics"
        folder.mkdir()
        for name, text in {"__init__": "", **files}.items():
            (folder / f"{name}.py").write_text(text)
        return importlib.import_module("some_metrics")

    yield of
    for name in [name for name in sys.modules if name.startswith("some_metrics")]:
        del sys.modules[name]


def test_metrics_of_several_files_stand_in_alphabetical_order(package):
    found = registry.collect(package(a=ONE + FIRST, b=ONE + PAIR.format(column="alpha")), Metric)
    assert list(found) == [one.column for one in found.values()] == ["alpha", "beta", "zeta"]


def test_a_column_that_stands_twice_is_refused(package):
    with pytest.raises(BadMetric, match=r"b\.py: there is a column 'zeta' already"):
        registry.collect(package(a=ONE + FIRST, b=ONE + PAIR.format(column="zeta")), Metric)


def test_a_file_without_a_metric_is_refused(package):
    with pytest.raises(BadMetric, match="has no METRIC that is a Metric, and no METRICS of them"):
        registry.collect(package(a="METRIC = 3.0"), Metric)
