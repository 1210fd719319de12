"""The history: lines that are refused by number, appending that loses nothing, and steps where there are steps."""

import json
import subprocess
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from support.builds import line
from support.command_line import bench, refused

from bench.errors import BadResults
from bench.provenance import ROOT
from bench.regression.history import log
from bench.regression.history.record import Commit, Record, from_json, of_comparison, to_json
from bench.regression.history.series import FLOPS, INSTRUCTIONS, TIME, series
from bench.regression.history.steps import BUILDS, steps
from bench.regression.revisions import comparison

GOOD = line(1, time=2.5, instructions=100.0, flops=45, mul=20)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "history.jsonl"


def test_line_reads_back_as_it_was():
    assert from_json(to_json(GOOD)) == GOOD
    assert "\n" not in to_json(GOOD)


def changed(**fields) -> str:
    return json.dumps(json.loads(to_json(GOOD)) | fields)


def measured(**fields) -> str:
    return changed(benchmark=json.loads(to_json(GOOD))["benchmark"] | fields)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "no JSON"),
        ("{", "no JSON"),
        ("[" * 100_000, "no JSON"),
        ("[]", "no object of schema"),
        (changed(schema="orientation-bench history 0"), "no object of schema"),
        (changed(more=1), "its fields are"),
        (changed(commit="HEAD"), "commit is 'HEAD'"),
        (changed(commit="--output=x"), "commit is"),
        (changed(date="yesterday"), "date is 'yesterday'"),
        (changed(place=0), "place is 0"),
        (changed(place="1"), "place is '1'"),
        (changed(machine="<b>"), "machine is '<b>'"),
        (changed(machine="../x"), "machine is"),
        (changed(compiler=1), "compiler is 1"),
        (changed(benchmark=[]), "its benchmark lacks"),
        (measured(name="<script>"), "name is '<script>'"),
        (measured(what="page"), "what is 'page'"),
        (measured(kernel_steps=[1.0, 2.0]), "kernel_steps is"),
        (measured(kernel_steps=[1.0, 2.0, float("nan")]), "kernel_steps is"),
        (measured(instructions=-1), "instructions is -1"),
        (measured(rounds=True), "rounds is True"),
        (measured(operations={"typical": {"flops": "45"}}), "operations is no object"),
        (measured(operations={"<b>": {"flops": 45}}), "an operation is '<b>'"),
    ],
)
def test_foreign_line_is_refused_by_its_number(path, text, problem):
    path.write_text(f"{to_json(GOOD)}\n{text}\n")
    with pytest.raises(BadResults, match="line 2: ") as found:
        log.read(path)
    assert problem in str(found.value)


def test_line_that_is_there_twice_is_refused_with_both_numbers(path):
    path.write_text(f"{to_json(GOOD)}\n{to_json(line(2))}\n{to_json(GOOD)}\n")
    with pytest.raises(BadResults, match="line 3: line 1 is about the same"):
        log.read(path)


def test_lines_come_in_the_order_of_their_commits(tmp_path):
    path = tmp_path / "deeper" / "history.jsonl"
    assert log.read(path) == []
    assert log.append([line(3), line(1)], path) == 2
    assert log.append([line(2), line(3, time=9.0)], path) == 1
    assert [one.commit for one in log.read(path)] == [line(at).commit for at in (1, 2, 3)]
    assert [one.name for one in path.parent.iterdir()] == ["history.jsonl"]


def test_append_to_a_broken_history_leaves_it_as_it_is(path):
    path.write_text(to_json(GOOD)[:-9])
    with pytest.raises(BadResults, match="line 1: no JSON"):
        log.append([line(2)], path)
    assert path.read_text() == to_json(GOOD)[:-9]


def test_line_that_could_not_be_read_again_is_not_written(path):
    odd = GOOD._replace(benchmark=GOOD.benchmark._replace(name="<script>"))
    with pytest.raises(BadResults, match="name is '<script>'"):
        log.append([GOOD, odd], path)
    assert not path.exists()


def write_some(path, first):
    for build in range(first, first + 20):
        log.append([line(build)], path)


def test_two_writers_lose_no_line(path):
    with ThreadPoolExecutor(2) as writers:  # the lock is of an open folder, not of a process
        list(writers.map(write_some, (path, path), (0, 100)))
    assert len(log.read(path)) == 40


def test_series_of_counts_is_one_across_machines_and_of_times_one_a_machine():
    lines = [line(at, machine=f"{'ab'[at % 2]}-cores", time=1.0, instructions=10.0, flops=5) for at in range(6)]
    found = {(one.measure, one.machine): len(one.points) for one in series(lines)}
    assert found == {(FLOPS, ""): 6, (INSTRUCTIONS, ""): 6, (TIME, "a-cores"): 3, (TIME, "b-cores"): 3}


def steps_of(lines, measure):
    [one] = [one for one in series(lines) if one.measure == measure]
    return steps(one)


def test_one_multiplication_more_is_a_step_with_its_words():
    lines = [line(at, flops=45 + (at >= 3), mul=20 + (at >= 3), add=25) for at in range(6)]
    [step] = steps_of(lines, FLOPS)
    assert (step.point.commit, step.was, step.now) == (lines[3].commit, 45, 46)
    assert step.says == "typical flops 45 to 46, typical mul 20 to 21, worst flops 45 to 46, worst mul 20 to 21"


def test_multiplication_turned_addition_is_a_step_though_flops_are_the_same():
    [step] = steps_of([line(0, flops=45, mul=20, add=25), line(1, flops=45, mul=19, add=26)], FLOPS)
    assert step.ratio == 1.0
    assert "mul 20 to 19" in step.says


@pytest.mark.parametrize(("now", "found"), [(100.0, 0), (100.05, 0), (100.2, 1), (99.0, 1)])
def test_instructions_step_beyond_what_they_repeat_to(now, found):
    assert len(steps_of([line(0, instructions=100.0), line(1, instructions=now)], INSTRUCTIONS)) == found


def test_instructions_of_the_same_machine_code_never_step_and_another_compiler_is_named():
    same = [line(0, instructions=100.0, code="ab"), line(1, instructions=120.0, code="ab")]
    assert steps_of(same, INSTRUCTIONS) == []
    other = [line(0, instructions=100.0), line(1, instructions=120.0, compiler="1" * 16)]
    assert "another compiler" in steps_of(other, INSTRUCTIONS)[0].says


def noisy(seed: int, levels, outliers: float = 0.05) -> list[Record]:
    """Times about these levels with 3 % of noise, and some half as long again, as on a shared machine."""
    draw = np.random.default_rng(seed)
    rare = np.where(draw.random(len(levels)) < outliers, 1.5, 1.0)
    times = np.array(levels) * (1.0 + 0.03 * draw.standard_normal(len(levels))) * rare
    return [line(at, time=float(time)) for at, time in enumerate(times)]


def test_time_without_a_change_has_no_step():
    assert [steps_of(noisy(seed, [2.0] * 30), TIME) for seed in range(40)] == [[]] * 40


def test_time_steps_at_its_build_up_and_down():
    for seed in range(10):
        found = steps_of(noisy(seed, [2.0] * 12 + [2.5] * 10 + [1.8] * 12, outliers=0.0), TIME)
        assert [abs(step.at - wanted) <= 1 for step, wanted in zip(found, (12, 22), strict=True)] == [True, True]
        assert found[0].ratio > 1.1
        assert found[1].ratio < 1 / 1.1


def test_time_that_changes_by_less_than_a_tenth_or_too_late_has_no_step():
    assert steps_of(noisy(0, [2.0] * 15 + [2.1] * 15), TIME) == []
    assert steps_of(noisy(0, [2.0] * 15 + [3.0] * (BUILDS - 1)), TIME) == []
    assert steps_of(noisy(0, [2.0] * (BUILDS - 1) + [3.0] * 15), TIME) == []


@pytest.fixture
def compared(tmp_path):
    """A comparison of two commits of this checkout, its numbers made up."""
    words = ["git", "-C", str(ROOT), "log", "-2", "--format=%H"]
    head, base = subprocess.run(words, capture_output=True, text=True, check=True).stdout.split()
    machine = {"key": "a-2-cores", "versions": {"numba": "1"}, "target": "x86-64-v3"}
    sides = (comparison.Side("base", base), comparison.Side("head", head))
    both = comparison.Benchmark("my-law", "law", line(0, flops=45).benchmark, line(0, flops=46).benchmark)
    gone = comparison.Benchmark("old-law", "law", line(0, flops=1).benchmark._replace(name="old-law"), None)
    path = tmp_path / "comparison.json"
    comparison.write(path, comparison.Comparison(*sides, machine, (), (), (both, gone)))
    return path


def test_builds_of_a_comparison_are_added_once_and_shown_with_their_steps(capsys, path, compared):
    assert "1 of 1 lines are new" in bench(capsys, "history", "add", compared, "--file", path).out
    both = ("--side", "base", "--side", "head")
    assert "2 of 3 lines" in bench(capsys, "history", "add", compared, "--file", path, *both).out
    said = bench(capsys, "history", "show", "--file", path)
    assert said.code == 0
    assert "Steps: 1 in 2 series" in said.out
    assert "typical flops 45 to 46" in said.out


def test_comparison_of_what_is_no_commit_is_refused(compared):
    given = comparison.read(compared)
    dirty = given._replace(head=comparison.Side("working tree"))
    with pytest.raises(BadResults, match="is no commit"):
        of_comparison(dirty, "head", lambda commit: Commit(commit, "", 1))


def test_comparison_of_another_checkouts_commit_is_refused(capsys, tmp_path, compared):
    compared.write_text(compared.read_text().replace(comparison.read(compared).head.commit, "0" * 40))
    line = refused(capsys, "history", "add", compared, "--file", tmp_path / "h.jsonl")
    assert "no such commit in this checkout" in line


def test_histories_of_two_machines_become_one(capsys, tmp_path):
    ours, theirs = tmp_path / "ours.jsonl", tmp_path / "theirs.jsonl"
    log.append([line(1), line(2)], ours)
    log.append([line(2), line(2, machine="b-4-cores"), line(3)], theirs)
    assert "2 of 3 lines are new" in bench(capsys, "history", "merge", theirs, "--file", ours).out
    assert len(log.read(ours)) == 4
    assert "no such file" in refused(capsys, "history", "merge", tmp_path / "none", "--file", ours)


def test_empty_history_says_how_to_begin(capsys, tmp_path):
    assert "the history is empty" in refused(capsys, "history", "show", "--file", tmp_path / "none.jsonl")


def test_history_of_this_checkout_can_be_read():
    lines = log.read()
    assert len({one.commit for one in lines}) >= 4
