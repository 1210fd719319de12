"""Rows are whose they say: what a law's process answers is checked, and parts are bound to their unit and plan."""

import dataclasses
import json
import os
import subprocess
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path

import pandas as pd
import pytest
from support import disturbed
from support.user_law import law_text, plan_of, spring_text

from bench.base.errors import BadLaw, BadResults
from bench.base.files import read_json
from bench.base.processes import module_command
from bench.base.provenance import ROOT
from bench.experiments import map as maps
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.request import Request
from bench.experiments.tables import packed, store
from bench.experiments.tables.schema import RESULTS, all_tables
from bench.law.contender import Contender
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import find_contender
from bench.running import run
from bench.running.sandbox.answers import check_rows

PATHS = sorted((RESULTS / "reference").glob("*.parquet"))


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_packed_rows_come_back_as_they_were(path):
    rows, table = store.read_arrow(path, path.stem).slice(0, 500), all_tables()[path.stem]
    back = packed.unpack(packed.pack(rows, table), table)
    pd.testing.assert_frame_equal(back.to_pandas().astype(object), rows.to_pandas().astype(object))


HEADINGS = ({"rows": -1}, {"rows": 10**12}, {"rows": "3"}, {"words": {}}, {"table": "map"}, {"version": "0"})


@pytest.mark.parametrize("change", HEADINGS, ids=str)
def test_rows_under_another_heading_are_refused(change):
    table = all_tables()["boundaries"]
    content = packed.pack(store.read_arrow(RESULTS / "reference" / "boundaries.parquet", table).slice(0, 3), table)
    (size,) = packed.LENGTH.unpack_from(content)
    text = json.dumps(json.loads(content[4 : 4 + size]) | change).encode()
    with pytest.raises(BadResults, match="no rows of the table 'boundaries'"):
        packed.unpack(packed.LENGTH.pack(len(text)) + text + content[4 + size :], table, 3)


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
    "outcome": lambda rows: rows.assign(outcome="excellent"),
}


@pytest.mark.parametrize("name", UNITS)
def test_rows_that_are_not_the_units_are_refused(name):
    settings, unit = Request("map" if name == "map" else "experiment"), UNITS[name]
    rows = rows_of(settings, unit)
    check_rows(settings, unit, rows)
    of_starts = {word: lambda rows, word=word: rows.assign(**{word: 0.5}) for word in ("quat_w", "horizon_s")}
    for lie in (LIES | (of_starts if name == "free-body" else {})).values():
        with pytest.raises(ValueError, match="row"):
            check_rows(settings, unit, lie(rows))


def test_flipped_bits_and_edits_of_parts_and_plan_are_noticed(tmp_path):
    found = disturbed.change_files(tmp_path, 12)
    assert found["bits"] == {disturbed.AGAIN: 12}
    assert {*found["edits"].values()} == {disturbed.AGAIN, disturbed.REFUSED}


DATA = tomllib.loads(Path(__file__).with_name("lying_laws.toml").read_text(encoding="utf-8"))
LAWS: dict[str, list[str]] = DATA["laws"]
OURS, SOUND = "rotation-matrix", "sound"


def write_law(folder: Path, name: str) -> Path:
    """Write the file of a law that lies, or of a sound one."""
    path, (answer, files) = folder / f"{name.replace('-', '_')}.py", LAWS.get(name, ("! pass", ""))
    text = DATA["head"] + DATA["loads" if answer.startswith("! ") else "lies"]
    for word, value in {"name": name, "origin": str(path), "answer": answer.removeprefix("! "), "files": files}.items():
        text = text.replace(f"{{{word}}}", value)
    path.write_text(text, encoding="utf-8")
    return path


def say(*words: object) -> dict:
    """Give a command, and return its code and what it printed."""
    done = subprocess.run(module_command("bench", *map(str, words)), cwd=ROOT, capture_output=True, text=True)
    said = done.stdout + done.stderr
    return {"code": done.returncode, "said": said[-600:], "traceback": "Traceback" in said}


def beside(folder: Path, names: Sequence[str], table: str, *words: object) -> dict[str, dict]:
    """Give a command with our law and a sound one, then twice with those that lie beside them."""
    found = {}
    for way, laws in {"alone": (), "beside": names, "again": names}.items():
        files = [word for name in (SOUND, *laws) for word in ("--law", write_law(folder, name))]
        out = folder / ("alone" if way == "alone" else "beside")
        found[way] = say(*words, "--regulator", OURS, *files, "--out", out)
        rows = store.read(out, table).astype({"regulator": str, "outcome": str})
        known = rows[rows["regulator"].isin((OURS, SOUND))].astype(object)
        found[way]["rows"] = known.to_json(orient="split", double_precision=15, index=False)
        found[way]["outcomes"] = {name: sorted({*rows.loc[rows["regulator"] == name, "outcome"]}) for name in laws}
    wanted = found.pop("alone")["rows"]
    return {way: one | {"same": one.pop("rows") == wanted} for way, one in found.items()}


def one_by_one(folder: Path, names: Sequence[str], words: str) -> dict[str, dict]:
    """Give a command for each law, and once more."""
    given = {f"{name}, {time}": name for name in names for time in ("once", "again")}
    return {each: say(*words.format(name=name, path=write_law(folder, name)).split()) for each, name in given.items()}


EPISODES = ("run", "--starts", "uniform", "--horizon", 0.02, "--count", 4, "--experiment", "free-body")
ON_ONE = (*EPISODES, "--engine", "ideal-rk4", "--law-limit", 5)
WAYS: dict[str, Callable[[Path, Sequence[str]], dict[str, dict]]] = {
    "run": lambda at, names: beside(at, names, "episodes", *ON_ONE),
    "local:2": lambda at, names: beside(at, names, "episodes", *ON_ONE, "--scheduler", "local:2"),
    "map": lambda at, names: beside(at, names, "map", "map", "--starts", 200, "--horizon", 0.02),
    "judge": lambda at, names: one_by_one(at, names, "judge {path}"),
    "export": lambda at, names: one_by_one(at, names, f"export {{name}} --law {{path}} --to c --out {at}/export"),
}
"""Every command that executes a law."""


SLOW = [pytest.param(way, [*LAWS][at::12], marks=pytest.mark.slow) for at, way in enumerate(WAYS)]
ALL = [pytest.param(way, [*LAWS], marks=pytest.mark.weekly) for way in WAYS]


@pytest.mark.parametrize(("way", "laws"), [("run", ["half-another-law", "edits-itself"]), *SLOW, *ALL])
def test_law_that_lies_loses_its_own_rows_alone(tmp_path, way, laws):
    """A mistake or lost rows, and no traceback; the rows of other laws as without it; and the same once more."""
    found = WAYS[way](tmp_path, laws)
    ended = [one["code"] in (1, 2) and not one["traceback"] and one.get("same", True) for one in found.values()]
    assert all(ended), found


def killed_while(folder, condition: str):
    """A plan of our law and one whose process is killed when it loads the file, while this holds."""
    plan = plan_of(folder, "pass", engine="ideal-rk4")
    killed = f"import os, sys\nif 'running/sandbox' in sys.argv[0] and {condition}: os.kill(os.getpid(), 9)\n"
    (folder / "mine.py").write_text(killed + spring_text("pass"))
    laws = (Contender(described(folder / "mine.py")),)
    return dataclasses.replace(plan, request=dataclasses.replace(plan.request, laws=laws))


def outcomes(folder, law: str) -> set:
    found = store.read(folder, "episodes").astype(str)
    return set(found.loc[found["regulator"] == law, "outcome"])


def test_process_killed_once_while_it_prepares_is_tried_again_alone(tmp_path):
    once = repr(str(tmp_path / "once"))
    run.run(killed_while(tmp_path, f"not os.path.exists({once}) and not os.mkdir({once})"), tmp_path / "run", workers=1)
    assert "crashed" not in outcomes(tmp_path / "run", "mine")


def test_process_killed_twice_is_tried_by_the_same_command(tmp_path):
    plan, out = killed_while(tmp_path, f"not os.path.exists({str(tmp_path / 'room')!r})"), tmp_path / "run"
    run.run(plan, out, workers=1)
    assert outcomes(out, "mine") == {"crashed"}
    assert read_json(out / "provenance.json")["again"] == [one.key for one in plan.units if one.law == "mine"]
    (tmp_path / "room").mkdir()
    assert run.run(plan, out, workers=1)
    assert outcomes(out, "mine") == outcomes(out, "rotation-matrix")
    assert not run.run(plan, out, workers=1)
    assert not os.path.exists(out / "parts")


@pytest.mark.parametrize(
    ("text", "reason"),
    [(law_text("pass") + "#" * (1 << 20), "has up to 1,048,576"), (spring_text(name="a" * 300), "up to 60 letters")],
    ids=["file of a megabyte", "name of 300 letters"],
)
def test_law_that_is_too_long_is_refused_when_it_is_read(tmp_path, text, reason):
    (tmp_path / "mine.py").write_text(text)
    with pytest.raises(BadLaw, match=reason):
        described(tmp_path / "mine.py")
