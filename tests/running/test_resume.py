"""A run killed at any moment goes on and ends with the same files; so does one stopped by Ctrl-C, on any threads."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
from support.command_line import ALONE, bench, digest

from bench.base.provenance import ROOT
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.running import run as running

TABLES = [
    *(
        "boundaries.parquet",
        "command-field.parquet",
        "compensators.parquet",
        "compliance.parquet",
        "costs.parquet",
        "episodes.parquet",
    ),
    *("goal-streams.parquet", "impedance-modes.parquet", "impedance.parquet"),
    *("plan.json", "pose-springs.parquet", "poses.parquet", "provenance.json", "robustness.parquet"),
    *("shipped.parquet", "springs.parquet"),
    *("traces.parquet", "velocity-limits.parquet", "velocity.parquet"),
]


def python(*words, **options):
    """A process of this interpreter in the root of the checkout."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (ROOT, ROOT / "tests")))}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen([sys.executable, *map(str, words)], cwd=ROOT, env=environment, **pipes, **options)


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """What `killed_runs` found."""
    done = python("-W", "ignore", "-m", "support.killed_runs", tmp_path_factory.mktemp("killed"))
    out, err = done.communicate(timeout=900)
    assert done.returncode == 0, err
    return json.loads(out)


def spoiled(runs: list[dict]) -> list[dict]:
    """The killed runs that did not go on to the same files."""
    return [one for one in runs if one["code"] != 0 or not one["same"]]


@pytest.mark.slow
def test_run_killed_at_random_moments_ends_with_the_same_files(killed):
    assert len(killed["at random moments"]) == 4
    assert spoiled(killed["at random moments"]) == []


@pytest.mark.slow
def test_random_moments_fall_into_the_middle_of_runs(killed):
    assert sum(0 < one["parts"] < killed["units"] for one in killed["at random moments"]) >= 1


@pytest.mark.slow
def test_run_killed_at_any_file_operation_of_its_end_ends_with_the_same_files(killed):
    assert len(killed["while finishing"]) > 5 * len(TABLES)
    assert spoiled(killed["while finishing"]) == []


@pytest.mark.slow
def test_run_killed_while_it_replaces_another_ends_with_the_same_files(killed):
    assert [".plan.json" in "".join(one["names"]) for one in killed["while clearing"]][-1]
    assert spoiled(killed["while clearing"]) == []


@pytest.mark.slow
def test_finished_run_leaves_its_tables_and_nothing_else(killed):
    assert killed["files"] == TABLES


@pytest.mark.slow
def test_one_thread_and_two_give_the_same_files(killed):
    assert killed["one thread"]


RUN = ("run", "--suite", "quick", *ALONE, "--starts", "half-turn", "--engine", "reference")
MANY = (*RUN, "--regulator", "rotation-matrix", "--count", "60", "--horizon", "1", "--workers", "1")
"""Fifteen units of four episodes, each about a tenth of a second: time to be stopped in, on a busy machine too."""


CONTROLLERS = (
    *("hybrid-base+inverse", "hybrid/zyx-euler+projected"),
    *("impedance-geometric", "impedance-coordinates/zyx-euler"),
)
IN_CONTACT = (
    *("run", "--suite", "quick", "--task", "wrench-probe", "--arm", "ur5e", "--count", "6", "--horizon", "0.1"),
    *("--experiment", "contact"),
    *(word for name in CONTROLLERS for word in ("--controller", name)),
    *("--workers", "1"),
)
"""Four units of at most 36 trials."""


def heed_interrupts():
    """For a child: a shell that starts the tests in the background has them, and theirs, ignore SIGINT."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.fixture(scope="module")
def interrupted(tmp_path_factory):
    """A run stopped by SIGINT after its first part: the finished process, what it printed, its folder."""
    out = tmp_path_factory.mktemp("interrupted") / "run"
    process = python("-m", "bench", *MANY, "--out", out, start_new_session=True, preexec_fn=heed_interrupts)
    while not list((out / "parts").glob("*.parquet")) and process.poll() is None:
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
    assert all(path.suffix == ".parquet" for path in (out / "parts").iterdir())


def test_stopped_run_in_contact_goes_on_and_ends_with_the_same_files(tmp_path, capsys):
    def stop_after_two(unit):
        keys.append(unit.key)
        if len(keys) == 2:
            raise KeyboardInterrupt

    keys: list[str] = []
    choice = Choice(("wrench-probe",), arms=("ur5e",), controllers=CONTROLLERS, experiments=("contact",))
    plan = planning.make("quick", [], choice, count=6, horizon_s=0.1)
    with pytest.raises(KeyboardInterrupt):
        running.run(plan, tmp_path / "stopped", workers=1, report=stop_after_two)
    kept = {path.stem for path in (tmp_path / "stopped" / "parts").iterdir()}
    assert set(keys) <= kept < {unit.key for unit in plan.units}
    said = bench(capsys, *IN_CONTACT, "--out", tmp_path / "stopped")
    assert f"going on: {len(kept)} of 4 units are done" in said.out
    assert bench(capsys, *IN_CONTACT, "--out", tmp_path / "undisturbed").code == 0
    resumed, undisturbed = digest(tmp_path / "stopped"), digest(tmp_path / "undisturbed")
    assert resumed.pop("provenance.json") != undisturbed.pop("provenance.json")
    assert resumed == undisturbed


def test_stopped_run_says_that_it_goes_on_and_ends_with_the_same_files(interrupted, tmp_path, capsys):
    out = interrupted[-1]
    parts = len(list((out / "parts").iterdir()))
    said = bench(capsys, *MANY, "--out", out)
    assert said.code == 0
    assert f"going on: {parts} of 15 units are done" in said.out
    assert bench(capsys, *MANY, "--out", tmp_path / "undisturbed").code == 0
    resumed, undisturbed = digest(out), digest(tmp_path / "undisturbed")
    assert resumed.pop("provenance.json") != undisturbed.pop("provenance.json")
    assert resumed == undisturbed
