"""The page on velocity commands: whole on the reference, silent on a run that has no such rows."""

import shutil

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole

from bench.tables.schema import RESULTS
from report.figures.arms import velocity_commands
from report.figures.kit.page import run_in

RUN = run_in(RESULTS / "reference")


def test_page_is_whole():
    assert_is_whole(velocity_commands, RUN)


def test_laws_that_are_dead_or_unwind_are_named():
    facts = velocity_commands.facts(RUN)
    assert "rotation matrix" in facts["dead"]
    assert "rotation vector" not in facts["dead"]
    assert "control: no sign" in facts["unwinds"]
    assert float(facts["worst_gap"]) < 1.0


def test_limit_stands_beside_its_closed_form():
    assert velocity_commands.line(RUN, "rotation-vector")["K dt, near"] == "2 (2)"


def test_run_without_velocities_says_so_everywhere(tmp_path):
    for name in ("episodes", "costs"):
        shutil.copy(RESULTS / "reference" / f"{name}.parquet", tmp_path)
    run = run_in(tmp_path)
    parts = (velocity_commands.facts, velocity_commands.tables, velocity_commands.figures)
    assert {value for part in parts for value in part(run).values()} == {None}
