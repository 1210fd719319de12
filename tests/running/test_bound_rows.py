"""Rows are whose they say: what a law's process answers is checked, and parts are bound to their unit and plan."""

import dataclasses
import os

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
from support.user_law import law_text, plan_of, spring_text

from bench.base.errors import BadResults
from bench.base.files import read_json
from bench.experiments import map as maps
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.tables import packed, store
from bench.experiments.tables.schema import RESULTS, all_tables
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import find_contender
from bench.running import run
from bench.running.answers import check_rows
from bench.studies.survival import flipped, hostile

PATHS = sorted((RESULTS / "reference").glob("*.parquet"))


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_packed_rows_come_back_as_they_were(path):
    rows, table = store.read_arrow(path, path.stem).slice(0, 500), all_tables()[path.stem]
    back = packed.unpack(packed.pack(rows, table), table)
    pd.testing.assert_frame_equal(back.to_pandas().astype(object), rows.to_pandas().astype(object))
    assert pq.ParquetFile(path).metadata.num_columns == len(table.names)


@pytest.mark.parametrize(
    "change",
    [{"rows": -1}, {"rows": 10**12}, {"rows": "3"}, {"words": {}}, {"table": "map"}, {"version": "0"}, "cut", "empty"],
    ids=str,
)
def test_bytes_that_are_no_rows_are_refused(change):
    table = all_tables()["boundaries"]
    content = packed.pack(store.read_arrow(RESULTS / "reference" / "boundaries.parquet", table).slice(0, 3), table)
    content = {"cut": content[:-1], "empty": b""}[change] if isinstance(change, str) else with_heading(content, change)
    with pytest.raises(BadResults, match="no rows of the table 'boundaries'"):
        packed.unpack(content, table, 3)


def with_heading(content: bytes, change: dict) -> bytes:
    """The bytes with other words in their heading."""
    (size,) = packed.LENGTH.unpack_from(content)
    text = packed.json.dumps(packed.json.loads(content[4 : 4 + size]) | change).encode()
    return packed.LENGTH.pack(len(text)) + text + content[4 + size :]


EPISODES = Unit("free-body", "rotation-matrix", "free-body", "", "ideal-rk4", "uniform", "nominal", 2, 3, 9, 3, 0.02)
UNITS = {
    "free-body": EPISODES,
    "map": maps.plan_of([find_contender("rotation-matrix")], 50, horizon_s=0.02).units[0],
    "robustness": Unit("robustness", "rotation-matrix", selector="delay", count=1, total=1, episodes=9, horizon_s=0.02),
    "boundaries": dataclasses.replace(EPISODES, experiment="boundaries", selector="", first=0, total=3),
}
LIES = {
    "another law": lambda rows: rows.assign(regulator="rotation-vector"),
    "coordinates": lambda rows: rows.assign(representation="quaternion"),
    "a row less": lambda rows: rows.iloc[1:],
    "a row twice": lambda rows: pd.concat([rows, rows.iloc[:1]]),
    "none": lambda rows: rows.iloc[:0],
    "outcome": lambda rows: rows.assign(outcome="excellent"),
}


@pytest.fixture(scope="module", params=UNITS)
def made(request):
    settings, unit = Settings("map" if request.param == "map" else "experiment"), UNITS[request.param]
    rows = rows_of(settings, unit)
    check_rows(settings, unit, rows)
    return settings, unit, rows


@pytest.mark.parametrize("lie", LIES)
def test_rows_that_are_not_the_units_are_refused(made, lie):
    settings, unit, rows = made
    with pytest.raises(ValueError, match=r"row|start"):
        check_rows(settings, unit, LIES[lie](rows))


@pytest.mark.parametrize("column", ["start_id", "quat_w", "horizon_s", "settling_time_s"])
def test_episode_from_another_start_is_refused(column):
    rows = rows_of(Settings(), EPISODES).assign(outcome="settled", settling_time_s=0.01)
    rows[column] = {"start_id": "uniform-00009", "settling_time_s": np.nan}.get(column, 0.5)
    with pytest.raises(ValueError, match="row"):
        check_rows(Settings(), EPISODES, rows)


def test_flipped_bits_and_edits_of_parts_and_plan_are_noticed(tmp_path):
    found = flipped.main(tmp_path, 12)
    assert found["bits"] == {flipped.AGAIN: 12}
    assert {name for name, became in found["edits"].items() if became in (flipped.SILENT, flipped.HARMLESS)} == set()


@pytest.mark.parametrize(
    ("way", "laws"),
    [
        ("run", ["half-another-law", "edits-itself"]),
        *(pytest.param(way, [*hostile.LAWS], marks=pytest.mark.slow) for way in hostile.WAYS),
    ],
)
def test_law_that_lies_loses_its_own_rows_alone(way, laws):
    found = hostile.main([way], laws)[way]
    assert hostile.is_well(found), found


KILLED = "if 'sandbox_process' in sys.argv[0] and {}: os.kill(os.getpid(), 9)\n"


def killed_while(folder, condition: str):
    """A plan of our law and one whose process is killed when it loads the file, while this holds."""
    plan = plan_of(folder, "pass", engine="ideal-rk4")
    path = folder / "mine.py"
    path.write_text("import os, sys\n" + KILLED.format(condition) + spring_text("pass"))
    own = described(path)
    return dataclasses.replace(plan, settings=plan.settings._replace(own=(own,)))


def outcomes(folder, law: str) -> set:
    found = store.read(folder, "episodes").astype(str)
    return set(found.loc[found["regulator"] == law, "outcome"])


def test_process_killed_once_while_it_prepares_is_tried_again_alone(tmp_path):
    first = f"not os.path.exists({str(tmp_path / 'once')!r}) and not os.mkdir({str(tmp_path / 'once')!r})"
    run.run(killed_while(tmp_path, first), tmp_path / "run", workers=1)
    assert "crashed" not in outcomes(tmp_path / "run", "mine")


def test_process_killed_twice_is_tried_by_the_same_command(tmp_path):
    plan, out = killed_while(tmp_path, f"not os.path.exists({str(tmp_path / 'room')!r})"), tmp_path / "run"
    run.run(plan, out, workers=1)
    assert outcomes(out, "mine") == {"crashed"}
    assert read_json(out / "provenance.json")["again"] == [one.key for one in plan.units if one.law == "mine"]
    (tmp_path / "room").mkdir()
    assert run.run(plan, out, workers=1)
    assert outcomes(out, "mine") == outcomes(out, "rotation-matrix")
    assert "again" not in read_json(out / "provenance.json")
    assert not run.run(plan, out, workers=1)
    assert not os.path.exists(out / "parts")


@pytest.mark.parametrize(
    ("text", "reason"),
    [(law_text("pass") + "#" * (1 << 20), "has up to 1,048,576"), (spring_text(name="a" * 300), "up to 60 letters")],
    ids=["file of a megabyte", "name of 300 letters"],
)
def test_law_that_is_too_long_is_refused_when_it_is_read(tmp_path, text, reason):
    (tmp_path / "mine.py").write_text(text)
    with pytest.raises(Exception, match=reason):
        described(tmp_path / "mine.py")
