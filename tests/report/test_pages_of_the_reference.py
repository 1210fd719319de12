"""Pages of the reference run: whole there, and "not in this run" where a run lacks their tables."""

import shutil

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole, pasted

from bench.experiments.tables import read
from bench.experiments.tables.schema import RESULTS
from report.figures.arms import velocity_commands
from report.figures.comparison import a_new_law, comparison
from report.figures.contact import as_arms_run
from report.figures.kit.page import ABSENT, run_in

RUN = run_in(RESULTS / "reference")


@pytest.mark.parametrize("page", [a_new_law, as_arms_run, comparison, velocity_commands])
def test_page_is_whole(page, monkeypatch):
    monkeypatch.setenv(read.VARIABLE, str(RESULTS / "reference"))
    assert_is_whole(page, RUN)


@pytest.mark.parametrize("page", [as_arms_run, velocity_commands])
def test_run_without_a_pages_tables_says_so(page, tmp_path):
    for name in ("episodes", "costs"):
        shutil.copy(RESULTS / "reference" / f"{name}.parquet", tmp_path)
    shown = pasted(page, run_in(tmp_path))
    assert all(ABSENT in getattr(value, "alt", str(value)) for value in shown.values())


def test_key_that_no_page_pastes_is_an_error(monkeypatch):
    monkeypatch.setattr(velocity_commands, "facts", lambda run: {"unread": 1})
    with pytest.raises(ValueError, match=r"velocity_commands gives \['unread'\], which its page does not paste"):
        pasted(velocity_commands, RUN)


def test_laws_that_are_dead_or_unwind_are_named():
    facts = velocity_commands.facts(RUN)
    assert "rotation matrix" in facts["dead"]
    assert "rotation vector" not in facts["dead"]
    assert "control: no sign" in facts["unwinds"]


def test_limits_are_written_with_their_closed_forms():
    assert velocity_commands.line(RUN, "rotation-vector")["K dt, near"] == "2 (2)"
