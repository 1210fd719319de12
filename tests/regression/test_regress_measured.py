"""Two small checkouts through the gates of instructions and time, and what is said when a side cannot be compiled."""

import shutil

import pytest
from support.user_law import law_text

from bench.errors import MissingTool
from bench.provenance import ROOT
from bench.regression.revisions import instructions, self_measure
from bench.regression.revisions.measured import Wanted, measured
from bench.regression.revisions.process import Laws, SideFailed, running


def side(folder, name, more):
    """A side that has nothing but one law of a user's."""
    file = folder / f"{name}.py"
    x = f"gains.kp * (goal.R.o[2] - R.o[2]){more} - gains.kv * omega[0]"
    file.write_text(law_text(f"return ({x}, -gains.kv * omega[1], -gains.kv * omega[2])", name="tilted"))
    return ROOT, Laws((file,), only=True, engines=False)


@pytest.fixture(scope="module")
def sides(tmp_path_factory):
    """A law, the same once more, and with three multiplications more."""
    folder = tmp_path_factory.mktemp("sides")
    more = {"base": "", "again": "", "head": " * R.n[0] * R.n[1] * R.n[2]"}
    with running([side(folder, name, what) for name, what in more.items()]) as processes:
        yield processes


@pytest.fixture(scope="module")
def two(sides):
    """The gates of a law against itself with more to multiply, few rounds."""
    base, _, head = sides
    assert {one.benchmarks["tilted"].ticks for one in (base, head)} == {20_000}
    return measured([base, head], ({}, {}), Wanted(rounds=6), lambda _: None)


def test_multiplications_more_are_other_code_and_so_timed(two):
    gates, _, [one] = two
    assert (one.name, one.what, one.same_code) == ("tilted", "law", False)
    assert one.time.rounds == one.base.rounds == one.head.rounds == 6
    assert one.base.kernel_steps.low <= one.base.kernel_steps.median <= one.base.kernel_steps.high
    assert [gate.gate for gate in gates] == ["instructions", "time"]


@pytest.mark.skipif(bool(instructions.missing()), reason=instructions.missing())
def test_multiplications_more_are_found_and_named_by_instructions(two):
    gates, found, [one] = two
    [said] = [finding for finding in found if finding.gate == "instructions"]
    assert (said.name, said.verdict) == ("tilted", "regression")
    assert 3.0 <= one.head.instructions - one.base.instructions <= 9.0  # each with a load at most
    assert gates[0].state == "failed"


def test_same_law_is_the_same_machine_code_and_is_not_timed(sides, monkeypatch):
    monkeypatch.setenv("PATH", "")
    gates, found, [one] = measured(sides[:2], ({}, {}), Wanted(rounds=6), lambda _: None)
    with pytest.raises(MissingTool, match="valgrind and setarch not found"):
        instructions.count(sides[0], self_measure.timed_laws(sides[0]))
    assert one.same_code
    assert (one.time, found) == (None, [])
    assert gates[0].state == "skipped"
    assert "valgrind and setarch not found" in gates[0].says


def test_side_that_cannot_import_says_so_and_which_it_is(tmp_path):
    """As a base from before there was bench.timing."""
    old = tmp_path / "old"
    shutil.copytree(ROOT / "bench", old / "bench", ignore=shutil.ignore_patterns("__pycache__", "timing"))
    with (
        pytest.raises(SideFailed, match=r"old cannot be compiled and timed \(.*no bench\.timing yet") as caught,
        running([(old, Laws(names=("rotation-matrix",), engines=False))]),
    ):
        pass
    assert caught.value.at == 0
