"""Tables, advice and audit from Python: `bench.load`, `bench.advise`, `bench.audit`."""

import shutil
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import bench
from bench.base.errors import BadResults, Incompatible, NoTable, UnknownWord
from bench.base.provenance import ROOT
from bench.cli.advise import Reply
from bench.cli.notebook import Advised
from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import all_tables

REFERENCE = ROOT / "results" / "reference"
FLOOR = ROOT / "results" / "floor" / "floor.parquet"


def test_rows_are_those_that_have_the_words():
    frame = bench.load("episodes", REFERENCE, engine="native", start_set="poles")
    whole = Run(REFERENCE).table("episodes")
    assert len(frame) == ((whole["engine"] == "native") & (whole["start_set"] == "poles")).sum() > 0
    assert "contender" in frame


def test_every_column_has_its_unit_also_in_files_that_lack_them():
    assert pd.read_parquet(FLOOR).attrs == {}, "the file carries units now: this test needs an older one"
    frame = bench.load(FLOOR)
    columns = all_tables()["floor"].columns()
    assert frame.attrs["units"] == {column.name: column.unit for column in columns}
    assert frame.attrs["meanings"][columns[0].name] == columns[0].meaning


def test_loading_leaves_what_others_read_as_it_is():
    bench.load("costs", REFERENCE)
    assert Run(REFERENCE).table("costs").attrs == {}


def test_pandas_reads_the_units_of_a_new_file(finished):
    units = pd.read_parquet(finished / "episodes.parquet").attrs["units"]
    assert units == bench.load("episodes", finished).attrs["units"]
    assert units["settling_time_s"] == "s"


def test_units_change_no_row(finished, tmp_path):
    """A file without them is read like a file with them."""
    import pyarrow.parquet as pq

    with_units = pq.read_table(finished / "episodes.parquet")
    metadata = {key: text for key, text in with_units.schema.metadata.items() if key != b"PANDAS_ATTRS"}
    older = shutil.copytree(finished, tmp_path / "older")
    pq.write_table(with_units.replace_schema_metadata(metadata), older / "episodes.parquet")
    pd.testing.assert_frame_equal(bench.load("episodes", older), bench.load("episodes", finished))


@pytest.mark.parametrize(
    ("words", "error", "says"),
    [
        ({"table": "episode"}, UnknownWord, "did you mean 'episodes'"),
        ({"table": "episodes", "engine": "ideal"}, UnknownWord, "did you mean 'ideal-rk4'"),
        ({"table": "episodes", "motor": "x"}, BadResults, "no column 'motor'"),
        ({"table": "nothing.parquet"}, NoTable, "there is no such file"),
        ({"table": ROOT / "results" / "nothing.parquet"}, NoTable, "there is no such file"),
    ],
)
def test_mistake_is_named_with_what_is_allowed(words, error, says):
    with pytest.raises(error, match=says):
        bench.load(folder=REFERENCE, **words)


def test_file_of_others_is_refused(tmp_path):
    pd.DataFrame({"x": [1]}).to_parquet(tmp_path / "theirs.parquet")
    with pytest.raises(BadResults, match="no table of ours"):
        bench.load(tmp_path / "theirs.parquet")
    (tmp_path / "text.parquet").write_text("no parquet")
    with pytest.raises(BadResults, match="no parquet file"):
        bench.load(tmp_path / "text.parquet")


def test_advice_says_in_words_why_no_law_is_advised():
    advised = bench.advise(kp=100, kv=20, delay="500ms")
    assert advised.law is None
    assert advised.table is None
    assert "No law" in repr(advised)
    assert advised.answer.near_goal.radius > 1.0


def test_advice_for_another_robot_is_the_commands():
    advised = bench.advise(robot="velocity")
    assert advised.law == advised.answer.law
    assert f"Use {advised.law}" in advised.text


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"kp": -3}, "give a number from"),
        ({"gain": 3}, "No such option"),
        ({"arm": "panda"}, "needs the stiffness"),
    ],
)
def test_option_that_is_not_allowed_is_refused(options, says):
    with pytest.raises(Incompatible, match=says):
        bench.advise(**options)


def test_laws_are_in_seconds_and_in_the_order_of_the_answer():
    numbers = ("time", "time_low", "time_high", "peak", "overshoot", "starts", "lost", "stuck", "trapped", "operations")
    rows = pd.DataFrame({"contender": ["mrp", "hybrid"], **{name: [8.0, 12.0] for name in numbers}})
    advised = Advised(Reply([], SimpleNamespace(law="mrp", rows=rows)), kp=16.0)
    assert advised.table["contender"].tolist() == ["mrp", "hybrid"]
    assert advised.table["time_s"].tolist() == [2.0, 3.0]
    assert advised.table["peak_rad_per_s2"].tolist() == [128.0, 192.0]
    assert advised.table.attrs["units"]["time_s"] == "s"
    assert rows.columns.tolist() == ["contender", *numbers]


def vee(R, R_d):
    """Return the rotation vector's sine, base frame."""
    E = np.asarray(R_d) @ np.asarray(R).T
    return 0.5 * np.array([E[2, 1] - E[1, 2], E[0, 2] - E[2, 0], E[1, 0] - E[0, 1]])


def test_audit_is_called_by_the_name_of_its_package():
    report = bench.audit(vee, name="vee")
    assert report.faults == ("dead-at-180",)
    assert str(report) == str(bench.audit.audit(vee, name="vee"))


def test_name_that_is_not_there_is_refused_with_those_that_are():
    with pytest.raises(AttributeError, match="it has advise, audit, load"):
        bench.nothing  # noqa: B018
