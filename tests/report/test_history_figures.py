"""The performance page: steps are listed build by build, and an empty history says so."""

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make report)")

from support.builds import line

from bench.regression.history import log
from report.figures.kit.page import Run
from report.figures.tool import performance


@pytest.fixture
def given(tmp_path):
    """A run beside which the history has these lines."""

    def of(lines):
        (tmp_path / "history" / log.LOG.name).unlink(missing_ok=True)
        log.append(lines, tmp_path / "history" / log.LOG.name)
        return Run(tmp_path, studies=tmp_path)

    return of


def builds(count=4):
    """Builds of one law on two machines: one multiplication more at the third, and the time with it."""
    return [
        line(at, machine=f"{machine}-2-cores", time=2.0, instructions=100.0 + (at > 1), flops=45 + (at > 1))
        for at in range(count)
        for machine in "ab"
    ]


def test_step_is_listed_once_though_two_machines_counted_it(given):
    shown = performance.history(given(builds()))
    assert [(step.series.measure, step.at) for step in shown.steps] == [("operations", 2), ("instructions", 2)]


def test_machines_are_counted(given):
    assert performance.facts(given(builds()))["machines"] == "2 machines"


def test_builds_are_listed_newest_first_with_their_steps(given):
    rows = performance.measured(performance.history(given(builds())))
    assert [row[-2:] for row in rows] == [(0, None), (2, "my-law"), (0, None), (0, None)]


def test_noise_is_of_builds_with_the_same_machine_code(given):
    lines = [line(at, time=time, code=code) for at, (time, code) in enumerate([(2.0, "a"), (2.2, "a"), (9.0, "b")])]
    run = given(lines)
    assert performance.same_code(performance.history(run)) == [pytest.approx(1.1)]
    assert performance.facts(run)["noise"] == "10.0\xa0%"
    found = performance.facts(given(lines[:1]))
    assert (found["same_code"], found["noise"]) == (0, "–")


def test_history_without_a_build_has_nothing_to_show(given):
    assert not any(performance.tables(given([])).values())
