"""Differences between two runs become findings: which law, what, how bad, in words."""

import shutil

import pytest

from bench.base.files import read_json, write_json
from bench.cli import main
from bench.experiments.tables.schema import table_of
from bench.experiments.tables.store import read, write_table
from bench.regression.revisions import gates
from bench.regression.revisions.exact import sort_findings
from bench.regression.revisions.gates import compare_measures
from bench.regression.rows import find_differences
from bench.regression.rows.difference import CHANGED, COLUMN, MISSING, NEW, Difference


def episode(column, was, now, law="rotation-matrix", start="half-turn-x", kind=CHANGED):
    blank = dict.fromkeys(table_of("episodes").key, "")
    row = blank | {"regulator": law, "start_set": "half-turn", "start_id": start, "engine": "native"}
    return Difference("episodes", kind, column, "", row, was, now)


def operations(column, was, now, stage="total"):
    row = {"regulator": "rotation-matrix", "representation": "", "branch": "worst", "stage": stage}
    return Difference("costs", CHANGED, column, "", row, was, now)


@pytest.mark.parametrize(
    ("column", "was", "now", "verdict"),
    [
        ("outcome", "settled", "timed-out", "regression"),
        ("outcome", "settled", "stuck", "regression"),
        ("outcome", "timed-out", "stuck", "regression"),
        ("outcome", "stuck", "settled", "improvement"),
        ("outcome", "diverged", "singular", "change"),
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
def test_change_of_an_episode_is_a_regression_if_it_got_worse(column, was, now, verdict):
    [found] = sort_findings([episode(column, was, now)])
    assert (found.verdict, found.name, found.gate) == (verdict, "rotation-matrix", "exact")
    assert "half-turn-x" in found.says
    assert ("new dead point" in found.says) == (now == "stuck")


def test_rows_that_say_the_same_are_one_finding_and_regressions_come_first():
    several = [episode("outcome", "settled", "diverged", start=f"start-{k}") for k in range(3)]
    other = episode("outcome", "settled", "diverged", law="mrp")
    found = sort_findings([episode("path_ratio", "1.0", "2.0"), *several, other])
    names = [("rotation-matrix", "regression"), ("mrp", "regression"), ("rotation-matrix", "change")]
    assert [(one.name, one.verdict) for one in found] == names
    assert "start-0, and 2 rows more" in found[0].says


@pytest.mark.parametrize(("now", "verdict"), [("26", "regression"), ("24", "improvement")])
def test_operation_is_said_once_for_all_stages_without_their_sum(now, verdict):
    stages = [operations("mul", "25", now, stage) for stage in ("regulate", "total")]
    [found] = sort_findings([*stages, operations("flops", "45", "46")])
    assert (found.gate, found.verdict, found.name) == ("operations", verdict, "rotation-matrix")
    assert found.says == f"rotation-matrix: mul 25 -> {now} a tick: worst total"


@pytest.mark.parametrize(("was", "now", "verdict"), [("nan", "1.2", "regression"), ("1.2", "nan", "improvement")])
def test_failure_that_comes_nearer_is_a_regression(was, now, verdict):
    row = {"regulator": "linearized-euler", "representation": "zyx-euler", "axis_x": "1.0"}
    [found] = sort_findings([Difference("boundaries", CHANGED, "fails_from_rad", "", row, was, now)])
    assert (found.verdict, found.name) == (verdict, "linearized-euler/zyx-euler")


def test_row_or_column_that_is_gone_is_a_regression_and_a_new_row_is_not():
    new, gone = (episode("", "", "", kind=kind) for kind in (NEW, MISSING))
    assert [one.verdict for one in sort_findings([new, gone])] == ["regression", "change"]
    assert sort_findings([gone])[0].says.startswith("rotation-matrix: gone from episodes: ")
    [found] = sort_findings([Difference("episodes", COLUMN, "effort", "episodes: column effort is missing", {})])
    assert (found.verdict, found.says) == ("regression", "episodes: column effort is missing")


def test_changed_judge_is_said_first_by_column_and_no_law_is_named(finished, tmp_path):
    head = shutil.copytree(finished, tmp_path / "head")
    rows = read(finished, "episodes")
    write_table(head / "episodes.parquet", rows.assign(outcome="stuck"), "episodes")
    assert {one.kind for one in find_differences(finished, head)} == {CHANGED}
    write_json(head / "provenance.json", read_json(head / "provenance.json") | {"judge": "another"})
    first, *others = gates.compare_folders(finished, head).findings
    assert (first.verdict, first.says[:17]) == ("regression", "the judge changed")
    assert [one.says for one in others] == [f"episodes: outcome: {len(rows)}"]


def test_table_of_an_experiment_newer_than_base_is_skipped_with_a_sentence_and_a_lost_one_is_not(finished, tmp_path):
    base = shutil.copytree(finished, tmp_path / "base")
    (base / "springs.parquet").unlink()
    [found] = gates.compare_folders(base, finished).findings
    assert found.verdict == "change"
    assert found.says == "springs: not compared, because the experiment is newer than the run in base"
    assert main(["compare", str(base), str(finished)]) == 0
    assert read(base, "springs").empty
    (base / "episodes.parquet").unlink()
    assert main(["compare", str(base), str(finished)]) == 2


def test_other_columns_of_a_law_are_folded_into_one_finding():
    others = [episode(name, "1.0", "2.0") for name in ("n_x", "n_y", "n_z", "path_ratio")]
    effort, folded = sort_findings([*others, episode("effort", "9.0", "11.0", start="start-1")])
    assert effort.says == "rotation-matrix: effort 9.0 -> 11.0: by native from start-1"
    assert folded.says == "rotation-matrix: 4 other columns moved"
    assert [one.split()[1] for one in folded.more] == ["n_x", "n_y", "n_z", "path_ratio"]


def test_measures_of_a_law_are_its_outcomes_and_medians_with_their_changes(finished, tmp_path):
    rows = read(finished, "episodes").assign(engine="ideal-rk4", outcome="settled", effort=100.0)
    sides = {"base": rows, "head": rows.assign(effort=102.0), "worse": rows.assign(outcome="stuck")}
    for name, changed in sides.items():
        shutil.copytree(finished, tmp_path / name)
        write_table(tmp_path / name / "episodes.parquet", changed, "episodes")
    lines = {line[""]: line for line in compare_measures(tmp_path / "base", tmp_path / "head")}
    assert lines["settled"]["base"] == lines["settled"]["head"]
    assert [lines["effort, median"][name] for name in ("base", "head", "change")] == ["100", "102", "+2.0%"]
    lines = {line[""]: line for line in compare_measures(tmp_path / "base", tmp_path / "worse")}
    assert (lines["settled"]["head"], lines["stuck"]["base"]) == ("none", "none")
