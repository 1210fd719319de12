"""Times of two sides: the rule on made-up rounds, and two small sides timed in turn."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support.command_line import bench, refused
from support.user_law import law_text

from bench.base.errors import BadResults, Incompatible
from bench.base.provenance import ROOT
from bench.regression.history import append_build, find_files, read_history
from bench.regression.revisions.times import RATIO, P, compare_times, confirm, judge_files, judge_rounds
from bench.regression.timer import Side, SideFailed, copy_benchmarks, run_benchmarks


def rounds(factor=1.0, spread=0.01, count=60):
    """(base, head): log-normal times, the head's times the factor."""
    draw = np.random.default_rng(20)
    return draw.lognormal(sigma=spread, size=count), factor * draw.lognormal(sigma=spread, size=count)


def judge(*given, **more):
    return judge_rounds("law", *rounds(*given, **more))


@pytest.mark.parametrize(
    ("factor", "spread", "is_sure", "verdict"),
    [
        (1.0, 0.01, False, "same"),
        (1.09, 0.01, True, "same"),
        (0.95, 0.01, True, "same"),
        (1.15, 0.8, False, "same"),
        (1.2, 0.01, True, "slower"),
        (1.0 / 1.2, 0.01, True, "faster"),
    ],
)
def test_law_is_another_only_when_chance_and_ratio_both_say_so(factor, spread, is_sure, verdict):
    found = judge(factor, spread)
    assert (found.p < P, found.verdict, found.confirmed) == (is_sure, verdict, None)
    assert found.low < found.ratio < found.high
    assert (verdict == "slower") == (is_sure and found.ratio > RATIO)


def test_ratio_is_of_neighbouring_rounds_whatever_the_machine_does():
    base, head = rounds(1.2)
    drift = np.linspace(1.0, 3.0, len(base))
    drifting = judge_rounds("law", base * drift, head * drift)
    assert drifting.ratio == pytest.approx(judge(1.2).ratio, rel=1e-12)


@pytest.mark.parametrize(("second", "verdict"), [(1.2, "slower"), (1.0, "same"), (1.0 / 1.5, "same")])
def test_second_run_must_agree_and_gives_the_numbers(second, verdict):
    found = confirm(judge(1.5), judge(second))
    assert (found.verdict, found.confirmed, found.ratio) == (verdict, verdict == "slower", judge(second).ratio)


@pytest.fixture(scope="module")
def sides(tmp_path_factory):
    """Two sides that have nothing but one law of a user's, and that of head multiplies much more."""
    folder, found = tmp_path_factory.mktemp("sides"), []
    for name, more in (("base", ""), ("head", " * R.n[0]" * 60)):
        x = f"gains.kp * (goal.R.o[2] - R.o[2]){more} - gains.kv * omega[0]"
        file = folder / f"{name}.py"
        file.write_text(law_text(f"return ({x}, -gains.kv * omega[1], -gains.kv * omega[2])", name="tilted"))
        found.append(Side(ROOT, (file,), only=True))
    return found


@pytest.fixture(scope="module")
def compared(sides):
    return compare_times(*sides, rounds=12)


def test_law_that_multiplies_sixty_times_more_is_slower_twice(compared):
    _, times = compared
    assert list(times) == ["tilted"]
    assert (times["tilted"].verdict, times["tilted"].confirmed) == ("slower", True)


def test_files_are_those_of_pytest_benchmark_and_name_no_machine(compared, tmp_path):
    files, _ = compared
    assert judge_files(*files)["tilted"].rounds == 12
    for name, content in zip(("0001_base", "0002_head"), files, strict=True):
        assert "node" not in content["machine_info"]
        (tmp_path / f"{name}.json").write_text(json.dumps(content))
    words = [Path(sys.executable).with_name("pytest-benchmark"), "compare", *tmp_path.iterdir()]
    said = subprocess.run(words, capture_output=True, text=True, check=True, cwd=tmp_path).stdout
    assert all(word in said for word in ("tilted", "0001", "0002", "2 tests"))


@pytest.mark.parametrize("at", [pytest.param(0, marks=pytest.mark.weekly), 1])
def test_side_that_cannot_compile_says_so_and_which_it_is(sides, tmp_path, at):
    broken = tmp_path / "broken.py"
    broken.write_text("REGULATOR = 1 / 0\n")
    both = list(sides)
    both[at] = Side(ROOT, (broken,), only=True)
    with pytest.raises(SideFailed, match=r"cannot be compiled and timed \(.*division by zero") as caught:
        run_benchmarks(both, rounds=2)
    assert caught.value.at == at


def test_base_that_lacks_what_the_benchmarks_import_says_so(tmp_path):
    (tmp_path / "bench").mkdir()
    (tmp_path / "bench" / "__init__.py").touch()
    copy_benchmarks(tmp_path)
    with pytest.raises(SideFailed, match=r"has no bench\.\S+: it is too old"):
        run_benchmarks([Side(tmp_path)], rounds=2)


def test_installation_without_benchmarks_says_where_they_are(monkeypatch, tmp_path):
    monkeypatch.setattr("bench.regression.timer.ROOT", tmp_path)
    with pytest.raises(Incompatible, match="clone the repository"):
        run_benchmarks([Side(tmp_path)], rounds=2)


def test_side_without_a_law_of_the_other_one_is_timed_in_what_both_have(sides, tmp_path):
    other = tmp_path / "other.py"
    other.write_text(law_text("return (0.0, 0.0, 0.0)", name="another"))
    base = sides[0]
    files = run_benchmarks([base, base._replace(laws=(*base.laws, other))], rounds=2)
    assert [[benchmark["param"] for benchmark in file["benchmarks"]] for file in files] == [["tilted"]] * 2
    files = run_benchmarks([base, base._replace(laws=(other,))], rounds=2)
    assert [file["benchmarks"] for file in files] == [[], []]


@pytest.fixture
def history(compared, tmp_path):
    """A history of two builds of one law, the later one added first."""
    folder = tmp_path / "history"
    (folder / "machine").mkdir(parents=True)
    for number, (day, content) in enumerate(zip((2, 1), compared[0], strict=True)):
        dated = content | {"commit_info": {"id": f"{day:040x}", "time": f"2026-01-0{day}T01:00:00+01:00"}}
        (folder / "machine" / f"000{number}_build.json").write_text(json.dumps(dated))
    return folder


def test_history_is_in_the_order_of_commits(history):
    rows = read_history(history)
    assert list(rows["commit"].str[-1]) == ["1", "2"]
    assert list(rows["name"]) == ["tilted", "tilted"]
    assert rows["kernel_steps"].between(rows["low"], rows["high"]).all()
    assert rows["kernel_steps"].iloc[0] > rows["kernel_steps"].iloc[1]


def test_file_that_is_no_build_is_refused_by_its_name(history):
    find_files(history)[1].write_text('{"benchmarks": []}')
    with pytest.raises(BadResults, match=r"0001_build\.json: no build of this history"):
        read_history(history)


def test_build_is_appended_in_the_storage_of_pytest_benchmark(monkeypatch, sides, tmp_path):
    monkeypatch.setattr("bench.regression.history.Side", lambda checkout: sides[0])
    monkeypatch.setattr("bench.regression.history.commit", lambda: {"commit": "1" * 40, "dirty": False})
    path = append_build(tmp_path, rounds=2)
    assert find_files(tmp_path) == [path]
    [row] = read_history(tmp_path).to_dict("records")
    assert (row["what"], row["name"], row["flops"] > 3) == ("law", "tilted", True)


def test_checkout_with_changes_is_not_appended(monkeypatch, tmp_path):
    monkeypatch.setattr("bench.regression.history.commit", lambda: {"commit": "1" * 40, "dirty": True})
    with pytest.raises(BadResults, match="changes that no commit holds"):
        append_build(tmp_path)


def test_command_shows_a_column_for_each_build_and_says_how_to_begin(history, capsys, tmp_path):
    said = bench(capsys, "history", "show", "--folder", history).out
    assert said.index("0000000000") < said.index("tilted") < said.index("2 builds")
    assert "the history is empty" in refused(capsys, "history", "show", "--folder", tmp_path / "none")
