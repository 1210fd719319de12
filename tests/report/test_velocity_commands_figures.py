"""The page on velocity commands: whole on a run that has them, silent on one that has not."""

import shutil

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole

from bench.experiments.experiment import Settings, Unit, rows_of
from bench.tables import store
from bench.tables.schema import RESULTS
from report.figures.arms import velocity_commands
from report.figures.kit.page import run_in

LAWS = ("rotation-vector", "rotation-matrix", "quaternion-shortest", "quaternion-unwinding")
BY = "rotation-vector@geometric+"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The reference with a few rows of robots commanded by velocities."""
    folder = tmp_path_factory.mktemp("velocity") / "run"
    shutil.copytree(RESULTS / "reference", folder)
    settings = Settings("quick")
    units = [Unit("velocity", law, "free-body", count=24, horizon_s=2.5) for law in LAWS]
    units += [
        Unit("velocity", BY + word, "arm-regulation", "ur5e", count=1, horizon_s=2.5) for word in ("solve", "transpose")
    ]
    limits = [Unit("velocity-limits", law, "free-body") for law in LAWS[:3]]
    limits += [Unit("velocity-limits", BY + word, "arm-regulation", "ur5e") for word in ("solve", "transpose")]
    for name, some in (("velocity", units), ("velocity-limits", limits)):
        frame = pd.concat([rows_of(settings, unit) for unit in some], ignore_index=True)
        store.write_table(folder / f"{name}.parquet", frame, name)
    return run_in(folder)


def test_page_is_whole(run):
    assert_is_whole(velocity_commands, run)


def test_laws_that_are_dead_or_unwind_are_named(run):
    facts = velocity_commands.facts(run)
    assert facts["dead"] == "rotation matrix"
    assert facts["unwinds"] == "control: no sign"
    assert float(facts["worst_gap"]) < 1.0


def test_limits_stand_beside_their_closed_forms(run):
    assert velocity_commands.line(run, "rotation-vector")["K dt, near"] == "2 (2)"
    assert velocity_commands.line(run, "quaternion-unwinding")["K dt, near"] == "–"  # was not bisected here


def test_run_without_velocities_says_so_everywhere(tmp_path):
    for name in ("episodes", "costs"):
        shutil.copy(RESULTS / "reference" / f"{name}.parquet", tmp_path)
    run = run_in(tmp_path)
    parts = (velocity_commands.facts, velocity_commands.tables, velocity_commands.figures)
    assert {value for part in parts for value in part(run).values()} == {None}
