"""Against right errors nothing is said, and their conventions are found; a finding names its file."""

import numpy as np
import pytest
from support.planted import PLANTED, audited
from support.right_errors import RIGHT, scipy_in_base

from bench.audit import audit
from bench.audit.report import as_dict
from bench.base.provenance import ROOT

DEAD = ("dead-at-180",)
"""The fault of a sine that is right everywhere else."""

NAMED = pytest.mark.parametrize(("function", "convention"), RIGHT.values(), ids=RIGHT)


@NAMED
def test_nothing_but_the_zero_of_a_sine_is_said_against_a_right_error_and_its_convention_is_found(function, convention):
    report = audited(function)
    assert report.faults == (DEAD if report.convention.form == "sine" else ())
    assert report.notes == ()
    found = report.convention
    assert (found.takes, found.frame, found.sign, found.form) == convention
    assert found.slope == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("scale", [0.5, 2.0, 30.0])
def test_slope_is_the_gain_that_is_in_a_function(scale):
    def scaled(R, R_d):
        return scale * scipy_in_base(R, R_d)

    assert audit(scaled).convention.slope == pytest.approx(scale)
    assert audit(scaled).faults == ("stiffness",)
    assert audit(scaled, stiffness=scale).faults == ()


def test_function_that_writes_on_its_input_has_that_fault_and_no_other():
    def writes(R, R_d):
        e = scipy_in_base(R, R_d)
        R[:], R_d[:] = 0.0, 0.0
        return e

    assert audit(writes).faults == ("changes-inputs",)


def test_function_that_takes_both_kinds_of_input_is_asked_as_stated():
    def both(now, goal):
        return scipy_in_base(now, goal) if now.shape == (3, 3) else np.zeros(3)

    assert audit(both).call.takes == audit(both, "matrix").call.takes == "matrix"
    assert audit(both, "wxyz").convention is None


def test_every_finding_names_the_file_that_looks_for_it():
    findings = [one for function, _ in list(PLANTED.values())[::4] for one in audited(function).findings]
    assert findings
    for one in findings:
        assert one.fault.title in (ROOT / as_dict(one)["file"]).read_text(encoding="utf-8")
