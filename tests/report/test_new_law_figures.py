"""The page of the law that brakes late: its figures and tables say what its scalar equation says."""

import math

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.findings.theory.isotropic import EQUATIONS
from report.figures.comparison import a_new_law as new_law

LATE = EQUATIONS["late-braking"]


def test_greatest_pull_is_the_closed_forms():
    assert new_law.greatest_pull(LATE) == pytest.approx(4.0 / 3.0 * math.sqrt(2.0 / 3.0), rel=1e-6)
