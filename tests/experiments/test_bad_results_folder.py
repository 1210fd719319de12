"""Folders of results that cannot be written, read or continued: one line, exit code 2, nothing touched."""

import shutil

import pyarrow.parquet as pq
import pytest
from support.command_line import TINY, bench, digest, refused, refused_run

from bench.base import files
from bench.base.errors import BadResults
from bench.experiments.columns import VERSION
from bench.experiments.tables import store


def test_file_in_place_of_a_results_folder_is_refused(capsys, tmp_path):
    path = tmp_path / "file"
    path.write_text("keep me")
    for out in (path, path / "below"):
        line = refused(capsys, "run", *TINY, "--engine", "reference", "--out", out)
        assert str(out) in line
        assert "choose another" in line
    assert path.read_text() == "keep me"


def test_folder_that_nobody_can_write_is_refused(capsys):
    """Not even root makes a folder in /proc, as in a read-only mount."""
    line = refused(capsys, "run", *TINY, "--engine", "reference", "--out", "/proc/orientation-bench")
    assert "cannot be written" in line
    assert "choose another folder" in line


def test_full_disk_is_one_line_and_leaves_no_file(tmp_path):
    def write(temporary):
        raise OSError(28, "No space left on device")

    with pytest.raises(BadResults, match=r"cannot be written \(No space left on device\); make room"):
        files.write_atomically(tmp_path / "table.parquet", write)
    assert list(tmp_path.iterdir()) == []


def test_foreign_folder_is_refused_even_with_replace(capsys, tmp_path):
    (tmp_path / "holiday.txt").write_text("photos")
    assert "something else than a run of ours" in refused_run(capsys, tmp_path, *TINY)


@pytest.mark.parametrize("content", ['{"steps": 3}', "[1, 2]", "{", ""])
def test_foreign_plan_is_refused_even_with_replace(capsys, tmp_path, content):
    (tmp_path / "plan.json").write_text(content)
    (tmp_path / "episodes.parquet").write_text("somebody's")
    line = refused_run(capsys, tmp_path, *TINY)
    assert "plan.json" in line


def test_other_plan_is_refused_with_the_cure(capsys, finished):
    before = digest(finished)
    line = refused(capsys, "run", "--out", finished, *TINY, "--engine", "reference", "--kp", "50")
    assert "it holds another plan" in line
    assert "--replace" in line
    assert digest(finished) == before


SAME = ("run", *TINY, "--engine", "reference")


def test_finished_run_of_the_same_plan_is_up_to_date(capsys, finished):
    before = digest(finished)
    said = bench(capsys, *SAME, "--out", finished)
    assert (said.code, said.err) == (0, "")
    assert "up to date" in said.out
    assert digest(finished) == before


def cut(path):
    path.write_bytes(path.read_bytes()[:-20])


@pytest.mark.parametrize("command", [("show",), ("claims",), ("compare",), SAME], ids=lambda words: words[0])
def test_truncated_table_is_refused_by_name(capsys, finished, command):
    cut(finished / "episodes.parquet")
    before = digest(finished)
    line = refused(
        capsys, *command, *(("--out",) if command == SAME else ()), finished, *[finished] * (command == ("compare",))
    )
    assert "episodes.parquet" in line
    assert "truncated" in line
    assert digest(finished) == before


def test_deleted_table_is_measured_again_by_the_same_command(capsys, finished):
    before = digest(finished)
    (finished / "episodes.parquet").unlink()
    assert bench(capsys, *SAME, "--out", finished).code == 0
    after = digest(finished)
    assert after.pop("provenance.json") != before.pop("provenance.json")
    assert after == before


def test_truncated_part_is_refused_by_name_before_anything_runs(capsys, finished):
    (finished / "provenance.json").unlink()
    (finished / "parts").mkdir()
    part = finished / "parts" / "free-body_reference_rotation-matrix_free-body_nominal_paper_000000.parquet"
    shutil.copy(finished / "episodes.parquet", part)
    cut(part)
    before = digest(finished)
    line = refused(capsys, *SAME, "--out", finished)
    assert part.name in line
    assert "delete it and run again" in line
    assert digest(finished) == before


@pytest.mark.parametrize("command", [("show",), SAME], ids=lambda words: words[0])
def test_table_of_another_schema_is_refused_with_both_versions(capsys, finished, command):
    path = finished / "episodes.parquet"
    table = pq.read_table(path)
    pq.write_table(table.replace_schema_metadata({**table.schema.metadata, b"orientation-bench schema": b"0"}), path)
    line = refused(capsys, *command, *(("--out",) if command == SAME else ()), finished)
    assert f"its schema is '0', this program reads '{VERSION}'" in line


@pytest.mark.parametrize("content", ["{", "[]", "{}"])
def test_broken_provenance_is_refused_by_name(capsys, finished, content):
    (finished / "provenance.json").write_text(content)
    assert "provenance.json" in refused(capsys, "show", finished)


@pytest.mark.parametrize("command", ["show", "claims", "compare"])
def test_reader_of_a_missing_or_unfinished_run_says_what_to_run(capsys, finished, command):
    second = [finished] * (command == "compare")
    assert "there is no such folder" in refused(capsys, command, finished / "nowhere", *second)
    (finished / "provenance.json").unlink()
    assert "has not finished" in refused(capsys, command, finished, *second)


def test_dry_run_touches_nothing(capsys, finished, tmp_path):
    before = digest(tmp_path)
    for out in (finished, tmp_path / "new", tmp_path / "new" / "deeper"):
        said = bench(capsys, "run", "--dry-run", "--replace", "--kp", "7", *TINY, "--out", out)
        assert (said.code, said.err) == (0, "")
        assert "episodes in" in said.out
    assert digest(tmp_path) == before


def test_folder_named_like_a_partition_is_read_as_it_is(capsys, tmp_path):
    """Arrow would take `kp=7` in a path for a column of that name and value."""
    out = tmp_path / "kp=7"
    assert bench(capsys, *SAME, "--kp", "7", "--out", out).code == 0
    assert set(store.read(out, "episodes")["kp"]) == {7.0}
    assert bench(capsys, "show", out).code == 0
