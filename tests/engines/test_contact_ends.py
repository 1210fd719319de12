"""Metrics of contact on records whose answers are known, of hands of known compliance, and by MuJoCo's own balance."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.contact_records import ARM, CARTESIAN, answered, pose, specification, spun, trial

from bench.engines.metrics.contact import held_axes, port, rest, stiffness, wrench
from bench.engines.metrics.contact_force import WINDOW_S, rms
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.metrics.measured_compliance import compliance, rotation_vector
from bench.engines.simulate_contact import run_contact as run
from bench.findings.theory.compliance_theory import free
from bench.law.contenders.impedances import geometric
from bench.law.control.contact_controller import impedance_controller
from tasks.contact import Specification
from tasks.domains import force_on_plane, surface_alignment, wrench_probe

DT, TICKS = 0.01, 401
TIME = DT * np.arange(TICKS)
NONE = pytest.approx(math.nan, nan_ok=True)
PRESSING = Specification("z", (1, 1, 0, 1, 1, 1), (0.0, 0.0, -20.0, 0.0, 0.0, 0.0))


def record(task=surface_alignment.TASK, rested=False, **arrays) -> Pose:
    """A hand that feels 20 N and does not move, but for the arrays given."""
    force = np.tile((0.0, 0.0, 20.0), (TICKS, 1))
    one = answered(trial(PRESSING), **({"time": TIME, "force": force} | arrays))
    return Pose(task, ARM, CARTESIAN, (one._replace(rested=rested),))


LATE = np.clip(TIME - 3.5, 0.0, None)
CREEPS = record(
    p=np.outer(LATE, (3e-3, 0.0, 4e-3)),
    R=ScipyRotation.from_rotvec(np.outer(LATE, (0.0, 0.02, 0.0))).as_matrix(),
)
FADES_S = 0.2
TILTS = ScipyRotation.from_rotvec(
    np.outer(0.3 * np.exp(-TIME / FADES_S), (1.0, 0.0, 0.0))
) * ScipyRotation.from_euler("x", np.pi)
"""The wrist points up, along minus the plate's normal, and its angle fades as exp(-t/FADES_S)."""
PEAKS = np.tile((100.0, 0.0, 20.0), (TICKS, 1))
PEAKS[17, 2] = 75.0
THERE_AND_BACK = record(p=np.outer(np.sin(np.pi * TIME / TIME[-1]), (0.0, 0.0, -0.1)))


@pytest.mark.parametrize("kept", [TICKS, 120])
def test_mean_error_is_over_the_window_and_what_rests_stays(kept):
    """An episode that ends at rest has the mean error of the same one watched for longer."""
    error = np.zeros((TICKS, 3))
    error[:, 0] = np.where(TIME < 1.0, 4.0, 2.0)
    short = record(rested=True, time=TIME[:kept])
    expected = math.sqrt((1.0 * 16.0 + (WINDOW_S - 1.0) * 4.0) / WINDOW_S)
    assert rms(short, lambda _: error[:kept]) == pytest.approx(expected, rel=1e-12)


@pytest.mark.slow
def test_hand_that_yields_to_a_moment_takes_energy_as_its_inertia_and_damping_do():
    """m theta(t) = m^2 free(t), free(t) being that of an inertia with a damper (compliance_theory)."""
    task = wrench_probe.TASK
    trial = next(one for one in task.trials(ARM) if "about x, moment +x" in one.id)
    ended = next(run("native", CARTESIAN, task, ARM, [trial]))
    taken = -port.port_energy(Pose(task, ARM, CARTESIAN, (response(trial, ended),)))
    assert taken == pytest.approx(wrench_probe.PUSH**2 * free(task.horizon_s), rel=5e-3)


SPRINGS = impedance_controller(geometric.IMPEDANCE)
MOMENTS = 0.02 * np.vstack((np.eye(3), -np.eye(3)))


def yielding(C, *held, controller=CARTESIAN, outcome="done"):
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
    turns = ScipyRotation.from_rotvec(np.random.default_rng(0).uniform(-1.5, 1.5, (50, 3)))
    np.testing.assert_allclose(rotation_vector(turns.as_matrix()), turns.as_rotvec(), atol=1e-14)


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
        dataclasses.replace(WHOLE, responses=WHOLE.responses[:2]),
        yielding(GENERAL, 0, 0, 1, outcome="singular"),
        dataclasses.replace(WHOLE, task=surface_alignment.TASK),
    ],
    ids=["moments do not span space", "an episode broke off", "something else touches the hand"],
)
def test_nothing_is_yielded_where(broken):
    assert np.isnan(compliance(broken)).all()


def leaning(angle: float) -> np.ndarray:
    """A hand that complies about y, and about an axis that leans from x by an angle towards -z."""
    axes = np.array(((math.cos(angle), 0.0, -math.sin(angle)), (0.0, 1.0, 0.0)))
    return 0.08 * axes.T @ axes


def turned(angle: float, yields=(0.1, 0.2, 0.3), axis="y") -> Pose:
    """Springs along the base's axes turned about one of them."""
    Q = ScipyRotation.from_euler(axis, angle).as_matrix()
    return yielding(Q @ np.diag(yields) @ Q.T, 0, 0, 0, controller=SPRINGS)


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


@pytest.mark.parametrize(
    ("measure", "measured", "found"),
    [
        (rest.time_to_rest, record(rested=True), pytest.approx(TIME[-1] - 0.25)),  # when the window began
        (rest.time_to_rest, record(), NONE),
        (rest.remaining_speed, CREEPS, pytest.approx(5e-3)),  # of the last window
        (rest.remaining_rate, CREEPS, pytest.approx(0.02)),
        (rest.remaining_speed, dataclasses.replace(CREEPS, task=force_on_plane.TASK), NONE),
        (rest.time_to_align, record(R=TILTS.as_matrix()), pytest.approx(FADES_S * math.log(50.0), abs=1.01 * DT)),
        (wrench.force_overshoot, record(force=PEAKS), pytest.approx(75.0 / 20.0 - 1.0)),  # of the component ordered
        (
            port.port_energy,
            record(p=np.outer(TIME**2, (0.0, 0.0, -0.01))),
            pytest.approx(0.2 * TIME[-1] ** 2, rel=1e-12),
        ),
        (port.port_energy, THERE_AND_BACK, pytest.approx(0.0, abs=1e-12)),
        (port.port_energy_peak, THERE_AND_BACK, pytest.approx(2.0, rel=1e-4)),
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
        *((stiffness.stiffness_axes, turned(angle), pytest.approx(angle, abs=1e-7)) for angle in (0.0, 0.2, 0.7)),
        (stiffness.stiffness_axes, turned(0.5, (0.1, 0.1 + 1e-9, 0.3), "z"), pytest.approx(0.0, abs=1e-7)),  # alike
    ],
)
def test_measure_of_a_record_is_what_was_put_into_it_or_follows_from_it(measure, measured, found):
    assert measure(measured) == found
