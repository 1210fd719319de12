"""Folders of results that cannot be written, read or continued: one line, exit code 2, nothing touched."""

import shutil

import pyarrow.parquet as pq
import pytest
from support.command_line import TINY, bench, digest, refused, refused_run

from bench.experiments.columns import VERSION
from bench.experiments.tables import store


def test_place_where_no_results_folder_can_be_is_refused(capsys, tmp_path):
    """A file, and /proc, where as in a read-only mount not even root makes a folder."""
    path, nowhere = tmp_path / "file", "/proc/orientation-bench"
    path.write_text("keep me")
    for out in (path, path / "below", nowhere):
        line = refused(capsys, "run", *TINY, "--engine", "reference", "--out", out)
        assert str(out) in line
        assert "choose another" in line
    assert "cannot be written" in line
    assert path.read_text() == "keep me"


FOREIGN = [("holiday.txt", "photos"), *(("plan.json", content) for content in ('{"steps": 3}', "[1, 2]", "{", ""))]


@pytest.mark.parametrize(("name", "content"), FOREIGN)
def test_foreign_folder_or_plan_is_refused_even_with_replace(capsys, tmp_path, name, content):
    (tmp_path / name).write_text(content)
    if name == "plan.json":
        (tmp_path / "episodes.parquet").write_text("somebody's")
    line = refused_run(capsys, tmp_path, *TINY)
    assert ("plan.json" if name == "plan.json" else "something else than a run of ours") in line


SAME = ("run", *TINY, "--engine", "reference")


def test_finished_run_of_the_same_plan_is_up_to_date(capsys, finished):
    before = digest(finished)
    said = bench(capsys, *SAME, "--out", finished)
    assert (said.code, said.err) == (0, "")
    assert "up to date" in said.out
    assert digest(finished) == before


def cut(path):
    path.write_bytes(path.read_bytes()[:-20])


def test_deleted_table_is_measured_again_by_the_same_command(capsys, finished):
    before = digest(finished)
    (finished / "episodes.parquet").unlink()
    assert bench(capsys, *SAME, "--out", finished).code == 0
    after = digest(finished)
    assert after.pop("provenance.json") != before.pop("provenance.json")
    assert after == before


def edit_the_plan(folder):
    """Other gains under the old digest."""
    path = folder / "plan.json"
    path.write_text(path.read_text().replace("100.0", "50.0"))


def set_other_schema(folder):
    table = pq.read_table(folder / "episodes.parquet")
    metadata = {**table.schema.metadata, b"orientation-bench schema": b"0"}
    pq.write_table(table.replace_schema_metadata(metadata), folder / "episodes.parquet")


def broken(content):
    return lambda folder: (folder / "provenance.json").write_text(content)


READERS = (("show",), ("claims",), ("compare",))
SPOILT = {
    "another plan": (lambda folder: None, [(*SAME, "--kp", "50")], ("gains [100.0, 20.0] there", "--replace")),
    "truncated table": (
        lambda folder: cut(folder / "episodes.parquet"),
        [*READERS, SAME],
        ("episodes.parquet", "truncated"),
    ),
    "edited plan": (edit_the_plan, [SAME], ("plan.json that was edited or damaged", "--replace")),
    "another schema": (
        set_other_schema,
        [("show",), SAME],
        (f"its schema is '0', this program reads '{VERSION}'",),
    ),
    **{f"provenance {content}": (broken(content), [("show",)], ("provenance.json",)) for content in ("{", "[]", "{}")},
    "unfinished": (lambda folder: (folder / "provenance.json").unlink(), READERS, ("has not finished",)),
    "gone": (shutil.rmtree, READERS, ("there is no such folder",)),
}
"""Fault -> what spoils a finished run, the commands that then refuse it, and what their line has."""


@pytest.mark.parametrize(
    ("fault", "command"), [(fault, words) for fault, (_, every, _) in SPOILT.items() for words in every]
)
def test_spoilt_run_is_refused_in_words_and_left_as_it_is(capsys, finished, fault, command):
    spoil, _, said = SPOILT[fault]
    spoil(finished)
    before = digest(finished)
    places = ("--out", finished) if command[0] == "run" else (finished,) * (1 + (command[0] == "compare"))
    line = refused(capsys, *command, *places)
    assert all(words in line for words in said)
    assert digest(finished) == before


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
    assert bench(capsys, "show", out, "--regulator", "rotation-matrix").code == 0
