"""Planted faults are named for what they are, and for nothing else."""

import numpy as np
import pytest
from support.planted import (
    PLANTED,
    audited,
    axis_clip,
    half_stiff,
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
        (norm_clip, {"allow": ("norm-clip",)}, ()),
        (axis_clip, {"allow": ("norm-clip",)}, ("axis-clip",)),
    ],
)
def test_what_is_stated_decides_what_is_a_fault(function, stated, faults):
    assert audit(function, **stated).faults == faults


def test_allowed_fault_stays_in_the_report():
    report = audit(norm_clip, allow=("norm-clip",), name="clipped")
    assert report.head().startswith("clipped: no fault found, 1 allowed: norm-clip (")
    assert "\nallowed norm-clip: " in report.text()


def cross_product(R, R_d):
    return 0.5 * np.cross(R.T, R_d.T).sum(axis=0)


def test_error_that_vanishes_at_180_by_its_form_is_a_fault_unless_it_is_allowed():
    report = audit(cross_product)
    assert (report.faults, report.notes, report.allowed) == (("dead-at-180",), (), ())
    assert "for 240 of 240 rotations by exactly 180°: its form is zero there" in report.text()
    assert "if the goal is never 180° away, allow dead-at-180" in report.text()
    allowed = audit(cross_product, allow=("dead-at-180",))
    assert (allowed.faults, allowed.allowed) == ((), ("dead-at-180",))


@pytest.mark.parametrize("power", [0.5, 1.0, 2.0])
def test_form_of_no_name_that_dies_away_before_180_has_the_fault_too(power):
    def dies(R, R_d):
        e = scipy_in_base(R, R_d)
        theta = np.linalg.norm(e)
        return e * np.cos(0.5 * theta) ** power if theta < np.pi else np.zeros(3)

    assert "dead-at-180" in audit(dies).faults


def test_error_that_is_small_before_180_but_not_zero_there_is_not_dead():
    def small(R, R_d):
        e = scipy_in_base(R, R_d)
        return e * (1.0 - 0.999 * np.linalg.norm(e) / np.pi)

    assert "dead-at-180" not in {finding.fault.name for finding in audit(small).findings}


def arc_cosine_unclipped(q, q_d):
    e = numpy_chord(q, q_d)
    return 2.0 * np.arccos(abs(q @ q_d)) * e / np.linalg.norm(e) if e.any() else e


def refuses(R, R_d):
    if abs(np.linalg.det(R) - 1.0) > 1e-9:
        raise ValueError("no rotation")
    return scipy_in_base(R, R_d)


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
    assert (report.notes, report.faults) == (("non-unit",), ())
    assert "no fault found, 1 note: non-unit (" in report.head()
    assert "non-unit" in audit(arc_cosine_unclipped).faults


def test_dead_point_of_some_axes_is_found():
    def about_x(q, q_d):
        return sign_of_zero(q, q_d) if abs(q_d[1]) == 1.0 else numpy_chord(q, q_d)

    (finding,) = audit(about_x).findings
    assert finding.fault.name == "dead-at-180"
    assert abs(finding.found.evidence.goal[1]) == 1.0
