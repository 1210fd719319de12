"""Tables on disk: schema and units, whole or absent, merged a part at a time; and two runs on one folder."""

import errno
import os
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
from support.command_line import TINY, bench, digest, refused, started
from support.user_law import law_text

from bench.base import files, lock
from bench.base.errors import BadResults
from bench.base.provenance import ROOT
from bench.experiments import columns as column
from bench.experiments.tables import schema, store

README = ROOT / "results" / "README.md"


def frame(table: str, rows: int, first: int = 0) -> pd.DataFrame:
    """Rows with every column of a table filled."""
    fill = {column.WORD: lambda i: f"word-{i % 3}", column.NUMBER: lambda i: i / 7.0, column.COUNT: lambda i: i}
    fill[column.SINGLE] = fill[column.NUMBER]
    return pd.DataFrame(
        {one.name: [fill[one.type](i) for i in range(first, first + rows)] for one in schema.table_of(table).columns()}
    )


@pytest.mark.parametrize("table", schema.all_tables())
def test_table_comes_back_with_a_meaning_of_every_column_and_a_unit_of_every_number(tmp_path, table):
    store.write_table(tmp_path / "x.parquet", frame(table, 5), table)
    found = pq.read_schema(tmp_path / "x.parquet")
    assert found.metadata[b"orientation-bench table"].decode() == table
    assert found.metadata[b"orientation-bench schema"].decode() == column.VERSION
    for one in schema.table_of(table).columns():
        metadata = found.field(one.name).metadata
        assert (metadata[b"unit"].decode(), metadata[b"meaning"].decode()) == (one.unit, one.meaning)
        assert one.meaning
        assert bool(one.unit) == (one.type != column.WORD), one.name


def test_numbers_come_back_bit_for_bit(tmp_path):
    numbers = [0.1, -0.0, 5e-324, 1.7976931348623157e308, float("inf"), float("nan")]
    given = frame("episodes", len(numbers)).assign(kp=numbers)
    store.write_table(tmp_path / "x.parquet", given, "episodes")
    found = store.read_arrow(tmp_path / "x.parquet", "episodes")["kp"].to_numpy()
    known = ~np.isnan(numbers)
    assert found[known].tobytes() == np.array(numbers)[known].tobytes()
    assert np.isnan(found[~known]).all()


@pytest.mark.parametrize("table", schema.all_tables())
def test_fractions_are_written_byte_by_byte_and_words_once(tmp_path, table):
    store.write_table(tmp_path / "x.parquet", frame(table, 5), table)
    columns = pq.ParquetFile(tmp_path / "x.parquet").metadata.row_group(0).to_dict()["columns"]
    types = {one.name: one.type for one in schema.table_of(table).columns()}
    for one in columns:
        is_number = types[one["path_in_schema"]] in (column.NUMBER, column.SINGLE)
        is_fraction = is_number and one["path_in_schema"] != "settling_time_s"  # whole control periods, which repeat
        assert ("BYTE_STREAM_SPLIT" in one["encodings"]) == is_fraction, one["path_in_schema"]
        assert one["has_dictionary_page"] != is_fraction, one["path_in_schema"]


@pytest.mark.parametrize("table", schema.all_tables())
def test_empty_table_keeps_its_columns(tmp_path, table):
    store.write_table(tmp_path / "x.parquet", frame(table, 0), table)
    found = store.read_arrow(tmp_path / "x.parquet", table)
    assert (found.num_rows, found.schema) == (0, schema.table_of(table).schema())


class Broken(Exception):
    """What a writer may raise."""


@pytest.mark.parametrize("stopped", [Broken, KeyboardInterrupt])
def test_writer_that_raises_leaves_no_file_and_the_old_one_whole_and_readable_by_all(tmp_path, stopped):
    def half(temporary):
        Path(temporary).write_text("half of it")
        raise stopped

    path = tmp_path / "table.json"
    for before in ([], ["table.json"]):
        with pytest.raises(stopped):
            files.write_atomically(path, half)
        assert [one.name for one in tmp_path.iterdir()] == before
        files.write_json(path, {"whole": 1})
    assert files.read_json(path) == {"whole": 1}
    assert path.stat().st_mode & 0o777 == 0o644


def parts(folder: Path, sizes) -> list[Path]:
    """Parts of an episodes table, numbered on."""
    paths, first = [], 0
    for size in sizes:
        paths.append(folder / f"part-{first}.parquet")
        store.write_table(paths[-1], frame("episodes", size, first), "episodes")
        first += size
    return paths


def read(paths: list[Path]):
    """Yield the parts one by one."""
    return (store.read_arrow(path, "episodes") for path in paths)


def test_merge_keeps_all_rows_in_the_order_of_the_parts(tmp_path):
    assert store.merge(tmp_path / "all.parquet", read(parts(tmp_path, (3, 1, 4))), "episodes") == 8
    found = store.read_arrow(tmp_path / "all.parquet", "episodes").to_pandas()
    pd.testing.assert_frame_equal(found.astype(object), frame("episodes", 8).astype(object), check_dtype=False)


def test_merge_writes_a_group_of_rows_as_soon_as_it_is_full(tmp_path):
    """So that memory does not grow with the number of episodes."""
    store.merge(tmp_path / "all.parquet", read(parts(tmp_path, (3, 1, 4, 2))), "episodes", group=4)
    found = pq.ParquetFile(tmp_path / "all.parquet").metadata
    assert [found.row_group(i).num_rows for i in range(found.num_row_groups)] == [4, 4, 2]


def test_merge_of_a_truncated_part_names_it_and_leaves_no_file(tmp_path):
    paths = parts(tmp_path, (3, 2))
    paths[1].write_bytes(paths[1].read_bytes()[:-9])
    with pytest.raises(BadResults, match=r"part-3\.parquet: it is truncated"):
        store.merge(tmp_path / "all.parquet", read(paths), "episodes")
    assert sorted(tmp_path.iterdir()) == sorted(paths)


def test_table_of_another_kind_is_refused(tmp_path):
    store.write_table(tmp_path / "x.parquet", frame("costs", 1), "costs")
    for opened in (store.read_arrow, store.check):
        with pytest.raises(BadResults, match=f"this program reads '{column.VERSION}' of table 'episodes'"):
            opened(tmp_path / "x.parquet", "episodes")


@pytest.mark.parametrize("kept", [0, 3, 100, -9, -1])
def test_truncated_table_is_told_from_its_end_alone(tmp_path, kept):
    [path] = parts(tmp_path, (50,))
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(BadResults, match="truncated"):
        store.check(path, "episodes")


def test_readme_of_results_is_the_one_the_schema_writes():
    """`make reference` writes it again, and only then has it the table of a new experiment."""
    texts = README.read_text(encoding="utf-8"), schema.readme()
    (first, *kept), (first_now, *now) = (text.split("\n## ") for text in texts)
    assert (first, kept) == (first_now, [one for one in now if one in kept])
    assert {path.name for path in schema.RESULTS.glob("reference/*.parquet")} <= {one.split("\n")[0] for one in kept}


RUN = ("run", *TINY, "--engine", "reference")
HOLD = """
import pathlib, sys
from bench.base import lock
with lock.lock_folder(pathlib.Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def holder(finished):
    """A process that holds the folder of a finished run."""
    with started("-c", HOLD, finished) as process:
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


@pytest.mark.parametrize("words", [(), ("--replace", "--kp", "7")], ids=["same plan", "another plan"])
def test_folder_of_another_run_is_refused_and_left_alone(capsys, holder, finished, words):
    before = digest(finished)
    line = refused(capsys, *RUN, *words, "--out", finished)
    assert re.search(rf"{finished}: another run \(process [0-9]+\) is writing into it", line)
    assert "choose another folder" in line
    assert digest(finished) == before


def test_killed_run_leaves_no_lock(capsys, holder, finished):
    before = digest(finished)
    holder.kill()
    holder.wait()
    assert bench(capsys, *RUN, "--out", finished).code == 0
    assert digest(finished) == before


def test_folder_that_cannot_be_locked_is_used_and_said_so(finished, capsys):
    def unsupported(*_):
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    with lock.lock_folder(finished, flock=unsupported):
        said = capsys.readouterr().err
    assert said.startswith(f"{finished}: cannot be locked (No locks available)")
    assert len(said.splitlines()) == 1


def test_refused_run_leaves_no_empty_folder(capsys, tmp_path):
    law = tmp_path / "own.py"
    law.write_text(law_text("return (float(str(omega[0])), 0.0, 0.0)"))
    words = ("--law", law, "--regulator", "mine", "--starts", "paper", "--engine", "ideal-rk4")
    assert "cannot be compiled" in refused(capsys, "run", *words, "--out", tmp_path / "new")
    assert not (tmp_path / "new").exists()
