"""Differences between two runs become findings: which law, what, how bad, in words."""

import shutil

import pytest

from bench.files import read_json, write_json
from bench.regression.revisions import gates
from bench.regression.revisions.exact import basins, findings, removed
from bench.regression.rows import differences
from bench.regression.rows.difference import CHANGED, COLUMN, MISSING, NEW, Difference
from bench.tables.schema import table_of
from bench.tables.store import read, write_table


def episode(column, was, now, law="rotation-matrix", start="half-turn-x"):
    blank = dict.fromkeys(table_of("episodes").key, "")
    row = blank | {"regulator": law, "start_set": "half-turn", "start_id": start, "engine": "native"}
    return Difference("episodes", CHANGED, column, "", row, was, now)


def operations(column, was, now, stage="total", law="rotation-matrix"):
    row = {"regulator": law, "representation": "", "branch": "worst", "stage": stage}
    return Difference("costs", CHANGED, column, "", row, was, now)


@pytest.mark.parametrize(
    ("was", "now", "verdict"),
    [
        ("settled", "timed-out", "regression"),
        ("settled", "stuck", "regression"),
        ("timed-out", "stuck", "regression"),
        ("stuck", "settled", "improvement"),
        ("diverged", "singular", "change"),
    ],
)
def test_outcome_is_a_regression_if_it_got_worse(was, now, verdict):
    [found] = findings([episode("outcome", was, now)])
    assert (found.verdict, found.name, found.gate) == (verdict, "rotation-matrix", "exact")
    assert (found.was, found.now) == (was, now)
    assert "half-turn-x" in found.says
    assert ("new dead point" in found.says) == (now == "stuck")


def test_rows_that_say_the_same_are_one_finding_and_regressions_come_first():
    several = [episode("outcome", "settled", "diverged", start=f"start-{k}") for k in range(3)]
    other = episode("outcome", "settled", "diverged", law="mrp")
    found = findings([episode("path_ratio", "1.0", "2.0"), *several, other])
    assert [(one.name, one.verdict, one.rows) for one in found] == [
        ("rotation-matrix", "regression", 3),
        ("mrp", "regression", 1),
        ("rotation-matrix", "change", 1),
    ]
    assert "start-0, and 2 rows more" in found[0].says


@pytest.mark.parametrize(("now", "verdict"), [("26", "regression"), ("24", "improvement")])
def test_operation_is_said_once_for_all_stages_without_their_sum(now, verdict):
    stages = [operations("mul", "25", now, stage) for stage in ("regulate", "total")]
    [found] = findings([*stages, operations("flops", "45", "46")])
    assert (found.gate, found.verdict, found.name, found.what) == (
        "operations",
        verdict,
        "rotation-matrix",
        "mul (worst)",
    )
    assert found.says.startswith(f"rotation-matrix: mul 25 -> {now} a tick")


@pytest.mark.parametrize(
    ("column", "was", "now", "verdict"),
    [
        ("settling_time_s", "0.73", "0.75", "regression"),
        ("settling_time_s", "0.73", "0.71", "improvement"),
        ("effort", "908", "1136", "regression"),
        ("effort", "908", "1134", "change"),
        ("peak_u", "100", "79", "improvement"),
        ("rest_change", "0.05", "0.9", "change"),  # too little to count
        ("rest_change", "0.05", "160", "regression"),
        ("rest_change", "160", "0.05", "improvement"),
        ("path_ratio", "1", "9", "change"),
    ],
)
def test_number_counts_by_its_sign_beyond_what_is_allowed(column, was, now, verdict):
    assert [one.verdict for one in findings([episode(column, was, now)])] == [verdict]


@pytest.mark.parametrize(("was", "now", "verdict"), [("nan", "1.2", "regression"), ("1.2", "nan", "improvement")])
def test_failure_that_comes_nearer_is_a_regression(was, now, verdict):
    row = {"regulator": "linearized-euler", "representation": "zyx-euler", "axis_x": "1.0"}
    [found] = findings([Difference("boundaries", CHANGED, "fails_from_rad", "", row, was, now)])
    assert (found.verdict, found.name) == (verdict, "linearized-euler/zyx-euler")


def test_row_that_is_gone_is_a_regression_and_a_new_one_is_not():
    row = episode("", "", "").row
    gone, new = (Difference("episodes", kind, "", "", row) for kind in (MISSING, NEW))
    assert [one.verdict for one in findings([new, gone])] == ["regression", "change"]


def test_changed_judge_is_said_first_by_column_and_no_law_is_named(finished, tmp_path):
    head = shutil.copytree(finished, tmp_path / "head")
    rows = read(finished, "episodes")
    write_table(head / "episodes.parquet", rows.assign(outcome="stuck"), "episodes")
    assert {one.kind for one in differences(finished, head)} == {CHANGED}
    write_json(head / "provenance.json", read_json(head / "provenance.json") | {"judge": "another"})
    first, *others = gates.of_folders(finished, head).findings
    assert (first.verdict, first.says[:17]) == ("regression", "the judge changed")
    assert [one.says for one in others] == [f"episodes: outcome: {len(rows)}"]


def test_changed_column_is_a_regression_in_its_own_words():
    [found] = findings([Difference("episodes", COLUMN, "effort", "episodes: column effort is missing", {})])
    assert (found.verdict, found.says) == ("regression", "episodes: column effort is missing")


def test_law_without_any_row_left_is_a_removed_contender(finished):
    row = episode("", "", "", law="mrp").row
    gone = [Difference("episodes", MISSING, "", "", one) for one in (row, episode("", "", "").row)]
    [found] = removed(gone, finished)
    assert (found.name, found.verdict) == ("mrp", "regression")
    assert "removed contender" in found.says


def test_basin_that_shrank_is_said_with_both_shares(finished, tmp_path):
    rows = read(finished, "episodes")
    rows = rows.assign(start_set="uniform", outcome="settled")
    write_table(finished / "episodes.parquet", rows, "episodes")
    assert basins(finished, finished) == []
    before = rows.assign(outcome=["settled", "stuck", "settled"][: len(rows)])
    head = shutil.copytree(finished, tmp_path / "head")
    write_table(head / "episodes.parquet", before, "episodes")
    [found] = basins(finished, head)
    assert (found.name, found.was, found.now) == ("rotation-matrix", "1.0000", "0.6667")
    assert "from 66.7% of all orientations, before from 100.0% (3 uniform starts, reference): lost basin" in found.says
    assert basins(head, finished) == []
