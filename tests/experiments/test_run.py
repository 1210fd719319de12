"""Runs as they are read: rows by their words, frames in place of tables, and what a run lacks."""

import pandas as pd
import pytest

from bench.base.errors import BadResults, NoEvidence, NoTable
from bench.experiments.tables.run import Run, shown_folder
from bench.experiments.tables.schema import RESULTS, all_tables
from bench.law.inputs import Gains

REFERENCE = RESULTS / "reference"
STARTS = pd.DataFrame(
    {
        "regulator": ["mrp", "mrp", "gibbs", "gibbs"],
        "representation": ["", "mrp", "zyx-euler", "mrp"],
        "jacobian": ["", "", "", "geometric"],
        "engine": ["ideal-rk4", "native", "ideal-rk4", "native"],
        "start_set": ["box", "poles", "uniform", "box"],
        "kp": [16.0] * 4,
        "kv": [8.0] * 4,
        "dt_s": [0.002] * 4,
    }
)


def test_several_words_of_a_column_choose_rows_with_any_of_them():
    run = Run(None, {"episodes": STARTS})
    rows = run.table("episodes", engine="native", start_set=("box", "poles"))
    assert list(rows["representation"]) == ["mrp", "mrp"]
    assert list(rows.index) == [0, 1]


def test_condition_that_is_noted_chooses_the_same_rows():
    run = Run(REFERENCE)
    words = {"task": "free-body", "engine": "native", "start_set": ("poles", "wraps")}
    rows = run.table("episodes", **words)
    [(name, condition)] = run.chosen
    expected = run.table(name).query(condition)
    assert len(rows) > 0
    assert list(rows["start_id"]) == list(expected["start_id"])


def test_rows_that_are_not_there_are_not_noted():
    run = Run(None, {"episodes": STARTS})
    assert len(run.table("episodes", engine="reference")) == 0
    assert run.chosen == []


def test_free_body_is_on_the_matrix_or_the_papers_angles():
    rows = Run(None, {"episodes": STARTS}).free_body("episodes")
    assert list(rows["representation"]) == ["", "zyx-euler"]


def test_gains_and_period_are_those_of_the_free_body():
    run = Run(None, {"episodes": STARTS})
    assert run.gains() == Gains(16.0, 8.0)
    assert run.period() == 0.002


def test_frame_stands_in_place_of_the_table_of_the_folder():
    run = Run(REFERENCE, {"episodes": STARTS})
    assert len(run.table("episodes")) == len(STARTS)
    assert len(run.table("costs")) == len(Run(REFERENCE).table("costs"))
    assert (run.is_as_stored, Run(REFERENCE).is_as_stored) == (False, True)


def test_probe_has_a_column_for_each_measure():
    run = Run(REFERENCE)
    long = run.table("probes", probe="elimination")
    wide = run.probe("elimination")
    assert set(long["measure"]) <= set(wide.columns)
    assert wide[[*set(long["measure"])]].notna().sum().sum() == long["value"].notna().sum()


@pytest.mark.parametrize(
    ("read", "error", "says"),
    [
        (lambda run: run.table("episodes", motor="x"), BadResults, "no column 'motor'"),
        (lambda run: run.table("costs"), NoEvidence, "there is no folder"),
        (lambda run: run.rows("episodes", engine="reference"), NoEvidence, "no rows of episodes"),
        (lambda run: run.provenance(), NoEvidence, "there is no folder"),
    ],
)
def test_what_frames_alone_lack_is_named(read, error, says):
    with pytest.raises(error, match=says):
        read(Run(None, {"episodes": STARTS}))


def test_table_without_a_file_is_refused_or_empty_with_its_columns(tmp_path):
    (tmp_path / "provenance.json").write_text("{}")
    run = Run(tmp_path)
    with pytest.raises(NoTable, match="there is no such file"):
        run.table("episodes")
    rows = run.any_rows("episodes", engine="native")
    columns = {column.name for column in all_tables()["episodes"].columns()}
    assert (len(rows), set(rows.columns)) == (0, columns | {"contender"})
    assert run.user_laws() == ()


def test_laws_are_found_by_the_names_of_rows():
    run = Run(REFERENCE)
    assert run.find_contender("feedback-linearized/zyx-euler@analytic+solve").name == (
        "feedback-linearized/zyx-euler"
    )
    assert run.find_contender("no-such-law") is None
    assert not run.is_users("hybrid")


def test_variable_names_the_folder_that_is_shown(monkeypatch, tmp_path):
    monkeypatch.setenv("ORIENTATION_BENCH_RESULTS", str(tmp_path))
    assert shown_folder() == tmp_path
