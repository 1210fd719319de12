"""Which law where a robot takes velocities; the rule itself is compared in test_answer_of_the_reference."""

import pytest
from support.advised import velocities

from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.measured import measured
from bench.findings.selection.robots import VELOCITY
from bench.findings.selection.robots import measure_velocities as measure

REFERENCE = RESULTS / "reference"


@pytest.mark.parametrize(
    "criterion", ["unsettled", "lost", "detour", "time", "worst", "peak", "tick", "memory", "arms"]
)
def test_criterion_of_velocity_laws_is_what_their_rows_say(criterion):
    found, expected = measured(REFERENCE, measure), velocities().number(criterion)
    assert {law: found.number(criterion, law) for law in expected.index} == pytest.approx(dict(expected), nan_ok=True)


def test_law_that_is_dead_and_law_that_unwinds_are_not_asked():
    asked = velocities().decide(VELOCITY).asked
    assert not {"rotation-matrix", "quaternion-unwinding"} & set(asked)
    assert "rotation-vector" in asked


def test_run_that_commands_no_robot_by_velocities_is_no_evidence(tmp_path):
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        measure(Results(tmp_path))
    rows = Results(REFERENCE).table("velocity").iloc[:0]
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        measure(Results(REFERENCE, {"velocity": rows}))
