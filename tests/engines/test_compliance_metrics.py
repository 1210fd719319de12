"""Metrics of the compliance that is measured by moments, on hands whose compliance is known."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as Turn
from support.contact_records import CARTESIAN, answered, pose, specification, spun, trial

from bench.engines.metrics.contact import held_axes, stiffness
from bench.engines.metrics.measured_compliance import compliance, rotation_vector
from bench.law.contenders.impedances import geometric
from bench.law.control.contact_controller import impedance_controller
from tasks.domains import surface_alignment

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
    turns = Turn.from_rotvec(np.random.default_rng(0).uniform(-1.5, 1.5, (50, 3)))
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
