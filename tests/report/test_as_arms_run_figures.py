"""The page on impedance without inertia shaping: whole on the reference, silent on a run that has no such rows."""

import shutil

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole

from bench.tables.schema import RESULTS
from report.figures.contact import as_arms_run as page
from report.figures.kit.page import run_in

RUN = run_in(RESULTS / "reference")


def test_page_is_whole():
    assert_is_whole(page, RUN)


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
