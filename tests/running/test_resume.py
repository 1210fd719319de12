"""A run killed at any moment goes on and ends with the same files; so does one stopped by Ctrl-C, on any threads."""

import json
import signal
import time

import pytest
from support.command_line import ALONE, bench, digest, started

from bench.experiments.experiment import known_experiments


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """What `support.disturbed` found."""
    done = started("-W", "ignore", "-m", "support.disturbed", tmp_path_factory.mktemp("killed"))
    out, err = done.communicate(timeout=900)
    assert done.returncode == 0, err
    return json.loads(out)


@pytest.mark.weekly
@pytest.mark.parametrize("moments", ["while running", "while clearing"])
def test_killed_run_goes_on_and_ends_with_the_same_files(killed, moments):
    assert [one for one in killed[moments] if one["code"] != 0 or not one["same"]] == []


@pytest.mark.weekly
def test_kills_fall_where_they_are_meant_to(killed):
    """At every file operation of a run, and of the clearing before it."""
    assert {one["parts"] for one in killed["while running"]} == set(range(killed["units"] + 1))
    assert len(killed["while running"]) > 5 * len(killed["files"])
    assert [".plan.json" in "".join(one["names"]) for one in killed["while clearing"]][-1]


@pytest.mark.weekly
def test_finished_run_leaves_its_tables_and_nothing_else(killed):
    tables = {f"{one.table.name}.parquet" for one in known_experiments().values() if one.in_suites}
    assert killed["files"] == sorted(tables | {"plan.json", "provenance.json"})


RUN = ("run", "--suite", "quick", *ALONE, "--starts", "half-turn", "--engine", "reference")
MANY = (*RUN, "--regulator", "rotation-matrix", "--count", "60", "--horizon", "1", "--workers", "1")
"""Fifteen units of four episodes, each about a tenth of a second: time to be stopped in, on a busy machine too."""


@pytest.fixture(scope="module")
def interrupted(tmp_path_factory):
    """A run stopped by SIGINT after its first part: the finished process, what it printed, its folder."""
    out = tmp_path_factory.mktemp("interrupted") / "run"
    # a shell that starts the tests in the background has them, and theirs, ignore SIGINT
    heed = {"start_new_session": True, "preexec_fn": lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)}
    process = started("-m", "bench", *MANY, "--out", out, **heed)
    while not list((out / "parts").glob("*.rows")) and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=60)
    return process.returncode, *said, out


def test_ctrl_c_exits_130_with_one_line(interrupted):
    """After an empty one, which ends the line that the terminal put ^C on."""
    code, _, err, _ = interrupted
    assert (code, len(err.strip().splitlines())) == (130, 1), err
    assert "what was finished is kept, and the same command goes on" in err


def test_ctrl_c_keeps_whole_parts_and_no_other_file(interrupted):
    out = interrupted[-1]
    assert sorted(path.name for path in out.iterdir()) == ["parts", "plan.json"]
    assert all(path.suffix == ".rows" for path in (out / "parts").iterdir())


def test_stopped_run_says_that_it_goes_on_and_ends_with_the_same_files(interrupted, capsys):
    out = interrupted[-1]
    kept = len(list((out / "parts").iterdir()))
    said = bench(capsys, *MANY, "--out", out)
    assert said.code == 0
    assert f"going on: {kept} of 15 units are done" in said.out
    assert bench(capsys, *MANY, "--out", out.with_name("undisturbed")).code == 0
    resumed, undisturbed = digest(out), digest(out.with_name("undisturbed"))
    assert resumed.pop("provenance.json") != undisturbed.pop("provenance.json")
    assert resumed == undisturbed
