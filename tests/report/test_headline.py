"""The headline figure: the paper's three laws and the advised one, from the same starts, under the paper's words."""

import re

import pytest

from bench.base.provenance import ROOT
from bench.experiments.tables.run import run_in
from bench.findings.conclusions import read_texts
from bench.findings.selection.regions import find_default
from report.figures.failures import failure_map
from report.figures.kit import laws


@pytest.fixture(scope="module")
def episodes():
    return run_in(ROOT / "results" / "reference").rows("episodes", engine="ideal-rk4")


def changed(episodes, contender, start_set, outcome):
    """Return the episodes with one outcome planted."""
    planted = episodes.copy()
    planted["outcome"] = planted["outcome"].astype(str)
    chosen = (planted["contender"] == contender) & (planted["start_set"] == start_set)
    planted.loc[chosen, "outcome"] = outcome
    return planted


def test_words_over_a_panel_are_the_papers_about_its_law():
    texts = read_texts()
    for panel, conclusion in zip(failure_map.list_panels(), failure_map.CONCLUSIONS.values(), strict=True):
        assert panel.contender.partition("/")[0] == conclusion or conclusion == "open-question"
        parts = panel.quote.split(" … ")
        assert all(part in texts[conclusion]["quote"] for part in parts)
        assert panel.section == texts[conclusion]["section"]


def test_panels_are_the_papers_laws_and_the_advised_one_from_the_same_starts(episodes):
    of_law = failure_map.find_common_starts(episodes)
    assert list(of_law) == [*laws.TITLES, find_default()]
    starts = {name: list(zip(rows["start_set"], rows["start_id"], strict=True)) for name, rows in of_law.items()}
    assert len({tuple(one) for one in starts.values()}) == 1
    assert len(next(iter(starts.values()))) > 500


def test_finding_counts_the_starts_that_are_lost(episodes):
    finding = failure_map.say_finding(episodes)
    of_law = failure_map.find_common_starts(episodes)
    lost = [int((rows["outcome"] != "settled").sum()) for rows in of_law.values()]
    rows = of_law[find_default()]
    assert [int(one) for one in re.findall(r": (\d+) start", finding)] == lost[:3]
    assert lost[3] == 0
    assert finding.endswith(f"With MRP with memory, the body settles from all {len(rows)} starts.")


def test_planted_failure_of_the_advised_law_is_said(episodes):
    planted = changed(episodes, find_default(), "poles", "stuck")
    rows = failure_map.find_common_starts(planted)[find_default()]
    stuck = int((rows["start_set"] == "poles").sum())
    assert stuck > 0
    assert failure_map.say_finding(planted).endswith(f"MRP with memory, the body never settles from {stuck} starts.")


def test_run_without_the_advised_law_says_so_and_shows_the_others(episodes):
    without = episodes[episodes["contender"] != find_default()]
    assert failure_map.say_finding(without).endswith("MRP with memory is not in this run.")
    assert "Since 1988" not in failure_map.hero(without).alt


def test_figure_says_what_it_shows_and_no_text_overlaps(episodes):
    drawn = failure_map.hero(episodes)
    assert drawn.clashes == ()
    for panel in failure_map.list_panels():
        assert panel.title in drawn.alt
        assert panel.quote in drawn.alt
