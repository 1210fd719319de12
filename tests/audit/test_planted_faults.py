"""Planted faults are named for what they are, and for nothing else."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.planted import (
    PLANTED,
    audited,
    axis_clip,
    deadband_of_components,
    half_stiff,
    log,
    norm_clip,
    sign_of_zero,
)
from support.right_errors import numpy_chord, scipy_in_base, scipy_in_body_from_goal
from support.users_errors import USERS

from bench.audit import audit

NAMED = pytest.mark.parametrize(("function", "faults"), PLANTED.values(), ids=PLANTED)


@NAMED
def test_planted_fault_is_named_and_no_other(function, faults):
    assert {one.fault.name for one in audited(function).findings} == faults


@NAMED
def test_evidence_is_what_the_function_says(function, faults):
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


def constant_in_the_denominator(R, R_d):
    """Zero below a thousandth, and a millionth too small elsewhere: digits of single precision, which it is not."""
    X = R_d @ R.T
    theta = np.arccos(np.clip(0.5 * (np.trace(X) - 1.0), -1.0, 1.0))
    sine = 0.5 * np.array((X[2, 1] - X[1, 2], X[0, 2] - X[2, 0], X[1, 0] - X[0, 1]))
    return theta / (np.sin(theta) + 1e-6) * sine if theta > 1e-3 else np.zeros(3)


def whole_turn_too_much(R, R_d):
    """An angle from 0 to 360°, of a quaternion of any sign."""
    q = np.roll(Rotation.from_matrix(R_d @ R.T).as_quat(), 1)
    length = np.linalg.norm(q[1:])
    return 2.0 * np.arctan2(length, q[0]) * q[1:] / length if length else np.zeros(3)


def unit_vector(R, R_d):
    """Return a vector of length 1 at every angle (bang-bang)."""
    e = scipy_in_base(R, R_d)
    return e / np.linalg.norm(e) if e.any() else e


def stiffer_with_the_angle(R, R_d):
    e = scipy_in_base(R, R_d)
    return e * np.sqrt(np.linalg.norm(e))


def saturated(R, R_d):
    """Smoothly, of the whole vector."""
    e = scipy_in_base(R, R_d)
    theta = np.linalg.norm(e)
    return np.tanh(theta) / theta * e if theta else e


RNG = np.random.default_rng(3)


def filtered():
    """A first-order filter of the error."""
    kept = np.zeros(3)

    def error(R, R_d):
        kept[:] = 0.9 * kept + 0.1 * scipy_in_base(R, R_d)
        return kept

    return error


def refuses(R, R_d):
    if abs(np.linalg.det(R) - 1.0) > 1e-9:
        raise ValueError("no rotation")
    return scipy_in_base(R, R_d)


def tangent(R, R_d):
    e = scipy_in_base(R, R_d)
    theta = np.linalg.norm(e)
    return 2.0 * np.tan(0.5 * theta) * e / theta if theta else e


OTHERS: dict = {
    "wrong-axis": (wrong_axis, {"axis-at-180"}),
    "raises-at-identity": (raises_at_identity, {"raises"}),
    "four-numbers-far-away": (four_numbers_far_away, {"raises"}),
    "deadband-of-a-vector-part": (lambda q, q_d: 0.5 * deadband_of_components(q, q_d), {"deadband", "stiffness"}),
    "constant-in-the-denominator": (constant_in_the_denominator, {"dead-at-180", "deadband"}),
    "whole-turn-too-much": (whole_turn_too_much, {"long-way"}),
    "unit-vector": (unit_vector, {"stiffness"}),
    "stiffer-with-the-angle": (stiffer_with_the_angle, {"stiffness"}),
    "saturated": (saturated, set()),
    "rounded": (lambda R, R_d: np.round(scipy_in_base(R, R_d), 1), {"deadband"}),  # its slope at the goal is 0
    "noisy": (lambda R, R_d: scipy_in_base(R, R_d) * (1.0 + 1e-3 * RNG.random()), {"memory"}),
    "filtered": (filtered(), {"memory"}),
}


@pytest.mark.parametrize(("function", "names"), OTHERS.values(), ids=OTHERS)
def test_other_fault_is_named_and_no_other(function, names):
    assert {one.fault.name for one in audited(function).findings} == names


@pytest.mark.parametrize(("expected", "function"), USERS.items())
def test_what_users_write_is_judged_for_the_right_reason(expected, function):
    _, faults, words = expected.split(" | ")
    report = audited(function)
    assert ", ".join(sorted(one.fault.name for one in report.findings)) == faults
    assert [said for said in words.split("; ") if said not in report.text()] == []


def test_numbers_that_overflow_print_no_warning(recwarn):
    audit(lambda R, R_d: scipy_in_base(R, R_d) * 1e300 / 1e-10)
    assert [one for one in recwarn if one.category is RuntimeWarning] == []


def test_refusal_of_input_that_is_off_is_a_note_and_another_answer_a_fault():
    report = audit(refuses)
    assert ([one.fault.name for one in report.findings], report.faults) == (["non-unit"], ())
    assert "non-unit" in audit(arc_cosine_unclipped).faults


def test_tangent_is_finite_in_no_double_at_180_but_huge():
    """tan(pi/2) of the double next to it is 1.6e16: a command that no robot survives."""
    assert audit(tangent).convention.form == "gibbs"


def test_dead_point_of_some_axes_is_found():
    def about_x(q, q_d):
        return sign_of_zero(q, q_d) if abs(q_d[1]) == 1.0 else numpy_chord(q, q_d)

    (finding,) = audit(about_x).findings
    assert finding.fault.name == "dead-at-180"
    assert abs(finding.found.evidence.goal[1]) == 1.0
