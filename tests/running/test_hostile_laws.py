"""No law fools the judge: whatever its file does, it is refused or its rows say it, and all else is as without it."""

import contextlib
import os
import tomllib
from pathlib import Path

import pandas as pd
import psutil
import pytest
from support.command_line import TINY, bench, refused, refused_run
from support.user_law import law_text, spring_text

import tasks
from bench.base.errors import BadLaw
from bench.base.processes import LAW_PROCESS
from bench.cli import main
from bench.experiments.free_body import MOST
from bench.experiments.tables import store
from bench.law.contenders.described_law import described
from tasks.rotations import columns

ASKED = ("--starts", "uniform", "--horizon", "0.02", "--law-limit", "1", "--experiment", "free-body")
OURS, SOUND = "rotation-matrix", "sound"
WAITS, LOOPS = "it did not return", "it did not return within 1 s"
WRITTEN = """
def written(said):
    for line in range(3, 64):
        try: os.write(line, said)
        except OSError: pass"""


IMPORTS = "import atexit, os, resource, shutil, signal, sys, threading, time"


def top(*lines: str) -> str:
    """A sound law with these lines at the top of its file."""
    return "\n".join((IMPORTS, *lines)) + spring_text(name="NAME")


def each(*lines: str) -> str:
    """A law that does this whenever it is called."""
    return spring_text("k = 0.0", *lines, name="NAME")


def some(line: str) -> str:
    """A law that does this in some states."""
    return each("if R.n[0] < -0.1:", f"    {line}")


def late(line: str) -> str:
    """A file that does this when it is imported in a run, and not when it is first read."""
    return top(f"if 'running/sandbox' in sys.argv[0]: {line}")


PLACES = {"top": top, "each": each, "some": some, "late": late}
DATA = tomllib.loads(Path(__file__).with_name("hostile_laws.toml").read_text(encoding="utf-8"))


def table(name: str) -> dict:
    """Return the laws of a table of hostile_laws.toml: the text of each and what becomes of it."""
    return {
        law: (PLACES[place](*(WRITTEN if line == "WRITTEN" else line for line in lines)), becomes)
        for law, (place, lines, becomes) in DATA[name].items()
    }


AT_IMPORT: dict[str, tuple[str | bytes | None, str]] = {
    **table("at-import"),
    "not-utf-8": (top("# caf\xe9").encode("latin-1"), "it is not UTF-8"),
    "nul": (b"x = 1\0", "does not import (SyntaxError"),
    "folder": (None, "there is no such file"),
    "empty": ("", "it has no REGULATOR"),
    "is-a-generator": (law_text("yield omega", name="NAME"), "returned <generator object"),
}
"""Refused, with the reason in one line."""

COMPILED = table("compiled")
"""Run on the engine ideal-rk4: what becomes of all episodes, or of some; "" of a law that runs as a sound one."""

IN_A_TICK = {law: tuple(told) for law, told in DATA["in-a-tick"].items()}
"""Python code: what a law answers in the first tick of an episode, one after the other."""

LOST = {law: tuple(told) for law, told in DATA["lost-in-a-tick"].items()}
"""Such answers, with which the episodes that run together are lost: each law has a file, and one such episode."""

A_UNIT = MOST["reference"]
"""Episodes that are run together in Python."""

IN_TURN = """
import atexit, ctypes, resource, signal, threading
{WRITTEN}
BEGINNINGS, ANSWERS = {beginnings}, [{answers}]
"""


def in_turn(beginnings: list[float], codes: list[str]) -> str:
    """A law that answers so in episodes that begin with these R.n[0], and else is sound."""
    answers = ", ".join(f"lambda R, omega, goal, gains, u: {code}" for code in codes)
    head = IN_TURN.format(WRITTEN=WRITTEN, beginnings=beginnings, answers=answers)
    first = "if R.n[0] in BEGINNINGS: return ANSWERS[BEGINNINGS.index(R.n[0])](R, omega, goal, gains, (-x, -y, -z))"
    return head + spring_text(first, name="NAME")


def written(folder, name: str, text):
    """The file of a case."""
    path = folder / f"{name}.py"
    if text is None:
        path.mkdir()
    else:
        path.write_bytes(text if isinstance(text, bytes) else text.replace("NAME", name).encode())
    return path


@pytest.fixture(autouse=True, scope="module")
def nothing_is_left_behind():
    """No process outlives its run."""
    marker = f"HOSTILE_{os.getpid()}"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(marker, "")
        yield
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            is_left = {LAW_PROCESS, marker} <= process.environ().keys() and process.status() != psutil.STATUS_ZOMBIE
            assert not is_left, process


@pytest.mark.parametrize("name", AT_IMPORT)
def test_file_that_misbehaves_is_refused(capsys, finished, tmp_path, name):
    """A run, a run on a cluster and the judge refuse it; a file that does not return is only read, for a short time."""
    text, reason = AT_IMPORT[name]
    path = written(tmp_path, name, text)
    if reason in (WAITS, LOOPS):
        with pytest.raises(BadLaw) as said:
            described(path, limit_s=1.0, waits_s=3.0 if reason == WAITS else 60.0)
        lines = [str(said.value)]
    else:
        ways = ((), ("--scheduler", "local:2"))
        lines = [refused_run(capsys, finished, "--law", path, *TINY, *way) for way in ways]
        lines.append(refused(capsys, "judge", path))
    assert all(str(path) in line and reason in line for line in lines), lines


def test_file_that_does_not_return_is_refused_by_the_judge(capsys, tmp_path):
    assert WAITS in refused(capsys, "judge", written(tmp_path, "sleeps", AT_IMPORT["sleeps"][0]))


def run(folder, engine, laws, *words) -> int:
    """The exit code of a run of one of our laws beside these of a user's."""
    files = [word for name, text in laws.items() for word in ("--law", written(folder, name, text))]
    count = len(IN_A_TICK) if engine == "reference" else 4
    out = ("--regulator", OURS, "--engine", engine, "--count", count, "--out", folder / "run")
    return main([str(word) for word in ("run", *files, *ASKED, *out, *words)])


def rows(folder, name):
    """The episodes of a law, but for its name."""
    found = store.read(folder / "run", "episodes").astype({"outcome": str})
    return found[found["regulator"] == name].drop(columns="regulator").reset_index(drop=True)


def same(one, other):
    """Which episodes are the same to the last bit."""
    one, other = one.astype(object), other.astype(object)  # words are categories, each table's own
    return ((one == other) | (one.isna() & other.isna())).all(axis=1)


BEGINNINGS = [columns(start.quat_wxyz)[0][0] for start in tasks.start_set("uniform", len(IN_A_TICK))]
LAWS = {
    "ideal-rk4": {name: text for name, (text, _) in COMPILED.items()},
    "reference": {
        "in-turn": in_turn(BEGINNINGS, [code for code, _ in IN_A_TICK.values()]),
        **{name: in_turn(BEGINNINGS[:1], [code]) for name, (code, _) in LOST.items()},
    },
}


@pytest.fixture(scope="module", params=LAWS)
def engine(request):
    return request.param


@pytest.fixture(scope="module")
def beside(engine, tmp_path_factory):
    """All of them in one run."""
    folder = tmp_path_factory.mktemp("beside")
    assert run(folder, engine, LAWS[engine]) == 1
    return folder


@pytest.fixture(scope="module")
def alone(engine, tmp_path_factory):
    """Our law, and one of a user's that is sound."""
    folder = tmp_path_factory.mktemp("alone")
    assert run(folder, engine, {SOUND: spring_text(name="NAME")}) == 0
    return folder


def test_laws_that_misbehave_leave_ours_as_it_is(beside, alone):
    assert same(rows(beside, OURS), rows(alone, OURS)).all()


def test_rows_of_a_law_that_misbehaves_say_so(engine, beside, alone):
    sound = rows(alone, SOUND)
    made = {name: rows(beside, name) for name in LAWS[engine]}
    becomes = {name: one["outcome"].where(~same(one, sound), "") for name, one in made.items()}
    expected: dict = COMPILED
    if engine == "reference":
        in_turn_becomes = becomes.pop("in-turn")
        assert all(set(words[A_UNIT:]) == {""} for words in becomes.values())
        becomes |= {name: [word] for name, word in zip(IN_A_TICK, in_turn_becomes, strict=True)}
        expected = IN_A_TICK | LOST
    found = {name: "".join(set(words) - {""}) for name, words in becomes.items()}
    assert found == {name: word for name, (_, word) in expected.items()}
    lost = pd.concat(one[one["outcome"] == "hung"] for one in made.values())
    assert lost[["quat_w", "angle0_rad", "kp", "horizon_s"]].notna().all(axis=None)
    assert lost[["settling_time_s", "failure_time_s", "peak_u", "effort"]].isna().all(axis=None)


def test_bench_shows_crashed_and_hung(capsys, beside):
    said = bench(capsys, "show", beside / "run", "--outcomes").out
    assert "crashed" in said
    assert "hung" in said


def test_run_of_a_law_that_only_raises_in_some_states_does_not_end_with_0(tmp_path):
    assert run(tmp_path, "ideal-rk4", {"raises": COMPILED["raises"][0]}) == 1


@pytest.mark.weekly
def test_cluster_makes_the_same_tables(engine, beside, tmp_path):
    assert run(tmp_path, engine, LAWS[engine], "--scheduler", "local:2") == 1
    made, wanted = ({path.name: path.read_bytes() for path in at.glob("run/*.parquet")} for at in (tmp_path, beside))
    assert made == wanted


FAST = ("without-end", "late-fratricide")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in FAST else pytest.mark.weekly) for name in COMPILED]
)
def test_law_that_misbehaves_does_not_pass_the_judge(capsys, tmp_path, name):
    said = bench(capsys, "judge", written(tmp_path, name, COMPILED[name][0]), "--law-limit", "1")
    assert said.code == 1
    assert "Traceback" not in said.err
    assert f"{name}: no fault" not in said.out


def test_law_of_python_alone_is_not_judged(capsys, tmp_path):
    assert "cannot be compiled" in refused(capsys, "judge", written(tmp_path, "in-turn", LAWS["reference"]["in-turn"]))
