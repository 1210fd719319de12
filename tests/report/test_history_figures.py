"""The performance page: steps are marked and listed, commits lead where they can be seen, an empty history says so."""

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make report)")

from support.builds import line

from bench.regression.history import log
from report.figures.tool import history, performance


@pytest.fixture
def given(monkeypatch):
    """Builds of one law on two machines: one multiplication more at the third, and the time with it."""

    def of(lines):
        monkeypatch.setattr(log, "read", lambda: lines)
        history.history.cache_clear()
        return history.history()

    yield of
    history.history.cache_clear()


def builds(count=4):
    return [
        line(at, machine=f"{machine}-2-cores", time=2.0, instructions=100.0 + (at > 1), flops=45 + (at > 1))
        for at in range(count)
        for machine in "ab"
    ]


def test_step_is_marked_and_listed_once_though_two_machines_counted_it(given):
    shown = given(builds())
    assert [(step.series.measure, step.at) for step in shown.steps] == [("operations", 2), ("instructions", 2)]
    table = performance.STEPS(performance.stepped(shown))
    assert len(table.splitlines()) == 3
    assert "45 → 46" in table
    assert "100 → 101" in table
    assert "typical flops 45 to 46" in history.chart(shown).alt


def test_every_machine_has_a_line_of_its_own(given):
    shown = given(builds())
    assert shown.machines == ("a-2-cores", "b-2-cores")
    assert len(shown.of("law", "my-law", "time")) == 2
    assert len(shown.of("law", "my-law", "operations")) == 1
    assert performance.facts(None)["machines"] == "2 machines"


def test_builds_are_listed_newest_first_with_their_steps(given):
    rows = performance.measured(given(builds()))
    assert [row[-1] for row in rows] == [0, 2, 0, 0]


def test_commit_leads_to_the_repository_that_the_citation_names(monkeypatch, tmp_path):
    name = "0123456789" * 4
    (tmp_path / "CITATION.cff").write_text('repository-code: "https://example.org/a/b"\n')
    monkeypatch.setattr(performance, "ROOT", tmp_path)
    performance.repository.cache_clear()
    assert f'href="https://example.org/a/b/commit/{name}"' in performance.commit(name)
    (tmp_path / "CITATION.cff").write_text("repository-code: javascript:alert(1)\n")
    performance.repository.cache_clear()
    assert "href" not in performance.commit(name)
    performance.repository.cache_clear()


def test_noise_is_of_builds_with_the_same_machine_code(given):
    lines = [line(at, time=time, code=code) for at, (time, code) in enumerate([(2.0, "a"), (2.2, "a"), (9.0, "b")])]
    assert performance.same_code(given(lines)) == [pytest.approx(1.1)]
    assert performance.facts(None)["noise"] == "10.0\xa0%"
    given(lines[:1])
    assert (performance.facts(None)["same_code"], performance.facts(None)["noise"]) == (0, "–")


def test_history_without_a_build_has_nothing_to_show(given):
    given([])
    assert not any((*performance.tables(None).values(), *performance.figures(None).values()))
