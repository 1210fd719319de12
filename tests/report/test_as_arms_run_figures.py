"""The page on impedance without inertia shaping: whole on a run that has it, silent on one that has not."""

import shutil

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole

from bench.contenders.registry import known_dampings
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.tables import store
from bench.tables.schema import RESULTS
from report.figures.contact import as_arms_run as page
from report.figures.kit.page import run_in

ARMS = ("panda", "ur5e")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The reference with a few rows of impedances that shape no inertia."""
    folder = tmp_path_factory.mktemp("impedance") / "run"
    shutil.copytree(RESULTS / "reference", folder)
    for table, more in (("impedance", {"count": 1, "horizon_s": 2.5}), ("impedance-modes", {})):
        units = [
            Unit(table, task="arm-regulation", arm=arm, selector=name, **more)
            for arm in ARMS
            for name in known_dampings()
        ]
        frame = pd.concat([rows_of(Settings("quick"), unit) for unit in units], ignore_index=True)
        store.write_table(folder / f"{table}.parquet", frame, table)
    return run_in(folder)


def test_page_is_whole(run):
    assert_is_whole(page, run)


def test_numbers_of_the_text_are_those_of_the_rows(run):
    facts = page.facts(run)
    assert facts["unstable"] == "Franka Emika Panda at 2000 N/m, 50 N m/rad"
    assert facts["double"] == "1.000 to 1.000"
    assert float(facts["felt_most"]) > 10.0
    assert float(facts["account"]) < 0.1
    assert float(facts["servo_gap"]) <= 0.1


def test_limit_is_written_with_its_closed_form_or_as_none():
    lines = page.limits()
    assert {len(line) for line in lines} == {7}
    assert lines[-1][2] == "none"
    assert "(" in lines[0][3]


def test_run_without_impedances_says_so_in_what_it_would_tell_of_them(tmp_path):
    for name in ("episodes", "costs"):
        shutil.copy(RESULTS / "reference" / f"{name}.parquet", tmp_path)
    run = run_in(tmp_path)
    assert set(page.in_free_motion(run).values()) == {None}
    assert page.tables(run)["tab_felt"] is None
    assert page.figures(run)["ratios-felt"] is None
