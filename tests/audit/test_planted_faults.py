"""Planted faults are named for what they are, and for nothing else."""

import mink
import numpy as np
import pytest
from support.planted import PLANTED, audited, axis_clip, half_stiff, log, norm_clip, sign_of_zero
from support.right_errors import numpy_chord, scipy_in_base, scipy_in_body_from_goal

from bench.audit import audit

NAMED = pytest.mark.parametrize("function", PLANTED, ids=lambda one: one.__name__)


@NAMED
def test_planted_fault_is_named_and_no_other(function):
    assert {one.fault.name for one in audited(function).findings} == PLANTED[function]


@NAMED
def test_evidence_is_what_the_function_says(function):
    for finding in audited(function).findings:
        now, goal, said, right = finding.found.evidence
        with np.errstate(all="ignore"):
            answer = function(now.copy(), goal.copy())
        np.testing.assert_array_equal(answer, said)
        if len(right):
            assert not np.allclose(answer, right, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize(
    ("function", "stated", "faults"),
    [
        (scipy_in_base, {"frame": "base", "sign": "to-goal"}, ()),
        (scipy_in_base, {"frame": "body"}, ("frame",)),
        (scipy_in_base, {"sign": "from-goal"}, ("direction",)),
        (scipy_in_base, {"frame": "base", "sign": "from-goal"}, ("direction",)),
        (scipy_in_body_from_goal, {"frame": "base", "sign": "to-goal"}, ("transpose",)),
        (numpy_chord, {"takes": "xyzw"}, ("quaternion-order",)),
        (half_stiff, {"stiffness": 0.5}, ()),
        (norm_clip, {"accept": ("norm-clip",)}, ()),
        (axis_clip, {"accept": ("norm-clip",)}, ("axis-clip",)),
    ],
)
def test_what_is_stated_decides_what_is_a_fault(function, stated, faults):
    assert audit(function, **stated).faults == faults


def test_accepted_fault_stays_in_the_report():
    assert "accepted norm-clip" in audit(norm_clip, accept=("norm-clip",)).text()


# --------------------------------------------------------------------------- faults that no function above has


def wrong_axis(R, R_d):
    """At 180° the axis from the diagonal alone: its signs are lost."""
    X = R_d @ R.T
    is_half = np.abs(X - X.T).max() < 1e-14 and np.trace(X) < 0.0
    return np.pi * np.sqrt(np.clip(0.5 * (np.diag(X) + 1.0), 0.0, 1.0)) if is_half else log(X)


def raises_at_identity(R, R_d):
    if np.array_equal(R, R_d):
        raise ZeroDivisionError("float division by zero")
    return scipy_in_base(R, R_d)


def four_numbers_far_away(R, R_d):
    e = scipy_in_base(R, R_d)
    return e if np.linalg.norm(e) < 3.0 else np.zeros(4)


def arc_cosine_unclipped(q, q_d):
    e = numpy_chord(q, q_d)
    return 2.0 * np.arccos(abs(q @ q_d)) * e / np.linalg.norm(e) if e.any() else e


def refuses(R, R_d):
    if abs(np.linalg.det(R) - 1.0) > 1e-9:
        raise ValueError("no rotation")
    return scipy_in_base(R, R_d)


def weighted(R, R_d):
    return np.array((1.0, 2.0, 3.0)) * scipy_in_base(R, R_d)


def tangent(R, R_d):
    e = scipy_in_base(R, R_d)
    theta = np.linalg.norm(e)
    return 2.0 * np.tan(0.5 * theta) * e / theta if theta else e


@pytest.mark.parametrize(
    ("function", "names"),
    [
        (wrong_axis, {"axis-at-180"}),
        (raises_at_identity, {"raises"}),
        (four_numbers_far_away, {"raises"}),
        (weighted, {"misaligned"}),
    ],
)
def test_other_fault_is_named_and_no_other(function, names):
    assert {one.fault.name for one in audited(function).findings} == names


def test_refusal_of_input_that_is_off_is_a_note():
    report = audit(refuses)
    assert ([one.fault.name for one in report.findings], report.faults) == (["non-unit"], ())


def test_input_that_is_off_and_answered_otherwise_is_a_fault():
    assert "non-unit" in audit(arc_cosine_unclipped).faults


def test_tangent_is_finite_in_no_double_at_180_but_huge():
    """tan(pi/2) of the double next to it is 1.6e16: a command that no robot survives."""
    assert audit(tangent).convention.form == "gibbs"


def test_minus_of_mink_is_dead_at_180():
    """mink 1.3.0's logarithm in Python multiplies by the sign of 0."""

    def minus(q, q_d):
        return (mink.SO3(q_d)).minus(mink.SO3(q))

    assert audit(minus).faults == ("dead-at-180",)


def test_dead_point_of_some_axes_is_found():
    def about_x(q, q_d):
        return sign_of_zero(q, q_d) if abs(q_d[1]) == 1.0 else numpy_chord(q, q_d)

    (finding,) = audit(about_x).findings
    assert finding.fault.name == "dead-at-180"
    assert abs(finding.found.evidence.goal[1]) == 1.0
