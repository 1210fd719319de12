"""The performance page: steps are marked and listed, commits lead where they can be seen, an empty history says so."""

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make report)")

from support.builds import line

from bench.regression.history import book
from report.figures.tool import history_chart, history_rows, history_said


@pytest.fixture
def given(monkeypatch):
    """Builds of one law on two machines: one multiplication more at the third, and the time with it."""

    def of(lines):
        monkeypatch.setattr(book, "read", lambda: lines)
        history_rows.history.cache_clear()
        return history_rows.history()

    yield of
    history_rows.history.cache_clear()


def builds(count=4):
    return [
        line(at, machine=f"{machine}-2-cores", time=2.0, instructions=100.0 + (at > 1), flops=45 + (at > 1))
        for at in range(count)
        for machine in "ab"
    ]


def test_step_is_marked_and_listed_once_though_two_machines_counted_it(given):
    shown = given(builds())
    assert [(step.series.measure, step.at) for step in shown.steps] == [("operations", 2), ("instructions", 2)]
    table = history_said.steps(shown)
    assert len(table.splitlines()) == 3
    assert "45 → 46" in table
    assert "100 → 101" in table
    assert "typical flops 45 to 46" in history_chart.chart(shown).alt


def test_every_machine_has_a_line_of_its_own(given):
    shown = given(builds())
    assert shown.machines == ("a-2-cores", "b-2-cores")
    assert len(shown.of("law", "my-law", "time")) == 2
    assert len(shown.of("law", "my-law", "operations")) == 1
    assert history_said.counts(shown)["machines"] == "2 machines"


def test_builds_are_listed_newest_first_with_their_steps(given):
    rows = history_said.builds(given(builds())).splitlines()[2:]
    assert [row.rsplit("|", 2)[1].strip() for row in rows] == ["0", "2", "0", "0"]


def test_commit_leads_to_the_repository_that_the_citation_names(monkeypatch, tmp_path):
    name = "0123456789" * 4
    (tmp_path / "CITATION.cff").write_text('repository-code: "https://example.org/a/b"\n')
    monkeypatch.setattr(history_rows, "ROOT", tmp_path)
    history_rows.repository.cache_clear()
    assert f'href="https://example.org/a/b/commit/{name}"' in history_rows.commit(name)
    (tmp_path / "CITATION.cff").write_text("repository-code: javascript:alert(1)\n")
    history_rows.repository.cache_clear()
    assert "href" not in history_rows.commit(name)
    history_rows.repository.cache_clear()


def test_noise_is_of_builds_with_the_same_machine_code(given):
    lines = [line(at, time=time, code=code) for at, (time, code) in enumerate([(2.0, "a"), (2.2, "a"), (9.0, "b")])]
    assert history_said.noise(given(lines)) == {"same_code": 1, "noise": "10.0\xa0%", "most_noise": "10.0\xa0%"}
    assert history_said.noise(given(lines[:1]))["same_code"] == 0


def test_history_without_a_build_says_how_to_begin(given):
    shown = given([])
    assert "python -m bench history add" in history_chart.chart(shown).alt
    assert len(history_said.steps(shown).splitlines()) == 2
