"""`bench time`: what is timed, the rows that become of it, a user's law. No time is asserted."""

import json
import math

import pandas as pd
import pytest
from benchmarks import arm_loops
from benchmarks.engine_loops import STARTS
from support.command_line import bench
from support.user_law import law_text, spring_text

from bench.base.errors import BadLaw
from bench.base.provenance import machine_key
from bench.cli.time import folder_for
from bench.experiments.tables.run import with_contender
from bench.experiments.tables.store import read_arrow
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of, find_contender
from bench.regression import timings
from bench.regression.timings import QUICK_ROUNDS, tabulate

LAWS = ("rotation-matrix", "linearized-euler/zyx-euler")
CONTENDERS = [find_contender(word) for word in LAWS]


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """A quick run of two laws, on one arm too: its file, and what it reported."""
    reported = []
    folder = tmp_path_factory.mktemp("timings")
    path = timings.time_laws(CONTENDERS, folder, quick=True, report=reported.append, arms=("ur5e",))
    return path, reported


def saved(steps):
    """A file of pytest-benchmark with one law: [median, low, high] in steps of the kernel, a median of 3 us."""
    info = {
        "what": "law",
        "arm": "",
        "engine": "",
        "contender": {"regulator": "mrp"},
        "ticks": 10,
        "kernel_steps": steps,
        "kernel_ns": 100.0,
    }
    stats = {"median": 3e-6, "rounds": 7}
    benchmark = {"extra_info": info, "stats": stats}
    return {"benchmarks": [benchmark], "not_timed": []}


def test_run_reports_every_benchmark_once_and_how_many_there_are(quick):
    _, reported = quick
    numbers = [progress.done for progress in reported]
    assert len({progress.name for progress in reported}) == len(reported)
    assert numbers == sorted(numbers)
    # The kernel and the empty loop have no name.
    assert {progress.total for progress in reported} == {len(reported) + 2}


def test_file_is_named_after_the_machine_and_says_where_it_comes_from(quick):
    path, _ = quick
    assert path.name == f"{machine_key()}.parquet"
    metadata = read_arrow(path, "timings").schema.metadata
    about = json.loads(metadata[b"about"])
    assert {"commit", "dirty", "versions", "cpu", "date"} <= set(about)
    assert about["quick"] is True


def test_file_has_one_row_of_times_for_everything_timed(quick):
    every = timings.read(quick[0])
    rows = every[every.arm == ""]
    names = with_contender(rows)["contender"].astype(str)
    expected = [f"law  {law}" for law in LAWS]
    for engine in sorted(STARTS):
        expected += [f"engine {engine} {law}" for law in LAWS]
    expected.append("loop  ")
    assert list(rows["what"].astype(str) + " " + rows["engine"].astype(str) + " " + names) == expected
    columns = ["ns_per_tick", "ns_reference_kernel", "ratio_low", "ticks"]
    assert (every[columns] > 0).all(axis=None)
    assert every.ratio.between(every.ratio_low, every.ratio_high).all()
    assert (every.passes == QUICK_ROUNDS).all()


def test_every_controller_of_the_default_suite_with_these_laws_is_timed_on_the_arm(quick):
    rows = timings.read(quick[0])
    loops = rows[(rows.arm == "ur5e") & (rows.what == "engine")]
    names = set(with_contender(loops)["contender"].astype(str))
    controllers = arm_loops.list_controllers(CONTENDERS, "ur5e")
    assert names == {controller.name for controller in controllers}
    assert {f"{law}@geometric+solve" for law in LAWS} < names


def test_tables_have_a_line_for_each_law_one_for_comparison_and_the_arms_apart(quick):
    rows = timings.read(quick[0])
    made = dict(timings.tables(rows))
    assert set(made) == {"", "ur5e"}
    assert list(made[""].law) == [*LAWS, "(empty loop)"]
    assert all(isinstance(cell, str) for cell in made[""].to_numpy().ravel())
    on_arm = made["ur5e"]
    assert list(on_arm.columns[:2]) == ["law", "native [ns]"]
    loops = rows[(rows.arm == "ur5e") & (rows.engine == "native")]
    assert len(on_arm) == len(loops)


def test_row_is_the_median_of_the_processes_and_its_interval_spans_theirs():
    files = [saved([2.0, 1.9, 2.2]), saved([2.4, 2.3, 2.5]), saved([2.1, 1.8, 2.3])]
    [row] = tabulate(files, []).to_dict("records")
    assert row["ratio"] == 2.1
    assert row["ratio_low"] == 1.8
    assert row["ratio_high"] == 2.5
    assert row["ns_per_tick"] == pytest.approx(300.0)
    assert row["passes"] == 21
    assert row["ticks"] == 10


def test_law_that_fails_is_a_row_without_a_time():
    file = saved([2.0, 1.9, 2.2])
    timed = file["benchmarks"][0]["extra_info"]
    failing = timed | {"contender": {"regulator": "gibbs"}, "ticks": 0}
    file["not_timed"].append(failing)
    rows = tabulate([file], [])
    gibbs = rows[rows["regulator"] == "gibbs"]
    assert math.isnan(gibbs["ratio"].item())
    assert gibbs["ticks"].item() == 0
    [(_, table)] = timings.tables(rows)
    assert list(table["alone [ns]"]) == ["300.0", "fails"]


def test_only_a_whole_run_writes_unasked_where_files_are_tracked():
    assert folder_for((), (), False).name == "timings"
    assert folder_for((), (), True).name == "timings-partial"
    assert folder_for((), ("gibbs",), False).name == "timings-partial"


def test_timings_go_into_the_folder_that_is_named(capsys, tmp_path):
    words = ("--quick", "--regulator", "gibbs", "--arm", "ur5e", "--out", tmp_path / "mine")
    assert bench(capsys, "time", *words).code == 0
    assert len(list((tmp_path / "mine").glob("*.parquet"))) == 1


def write_law(tmp_path, text):
    """Write a user's law; return one of our laws and the user's."""
    path = tmp_path / "own.py"
    path.write_text(text)
    return [find_contender("rotation-matrix"), *contenders_of(described(path))]


def test_law_of_a_user_is_timed_beside_ours_and_one_that_fails_is_a_row_without_a_time(tmp_path):
    laws = write_law(tmp_path, law_text("return (sqrt(-1.0 - R.n[0] * R.n[0]), omega[1], omega[2])"))
    path = timings.time_laws(laws, tmp_path / "timings", quick=True)
    rows = timings.read(path)
    alone = rows[rows["what"] == "law"].set_index("regulator")["ns_per_tick"]
    assert alone["rotation-matrix"] > 0
    assert pd.isna(alone["mine"])


def test_law_that_cannot_be_compiled_is_refused(tmp_path):
    line = "if R.n[0] < 2.0 and omega[0] == omega[0]: os._exit(0)"
    laws = write_law(tmp_path, spring_text(line))
    with pytest.raises(BadLaw, match=r"own\.py.*cannot be compiled"):
        timings.time_laws(laws, tmp_path / "timings", quick=True)
    assert not (tmp_path / "timings").exists()
