"""Chapters 1 to 3: the way from the paper to its rows, figures on the same axes, the order of costs."""

import shlex

import pandas as pd
import pytest
from support.command_line import bench
from support.pages import RUN

from bench.findings.claims import all_claims
from bench.findings.claims.errata import COVERAGE
from report.figures.cost import cost, plane
from report.figures.cost.plane import LawPoint
from report.figures.kit.page import REPORT
from report.figures.replication import paper_index
from report.figures.responses import responses

COMMANDS = sorted(set(paper_index.read_commands().values()) - {""})


def test_every_part_of_the_paper_has_its_command():
    assert list(paper_index.read_commands()) == [item.paper for item in COVERAGE]


@pytest.mark.parametrize("command", COMMANDS)
def test_command_of_a_part_of_the_paper_can_be_planned(command, capsys, tmp_path, monkeypatch):
    program, name, *words = shlex.split(command)
    assert program == "bench"
    harmless = ["--dry-run"] if name == "run" else ["--help"]
    monkeypatch.chdir(tmp_path)
    assert bench(capsys, name, *words, *harmless).code == 0


def test_part_of_the_paper_leads_to_page_claims_and_tables():
    items = paper_index.facts(RUN)["items"]
    [row] = [line for line in items.splitlines() if line.startswith("| (2.12) |")]
    assert "[chapter 2](02-three-regulators.md)" in row
    assert 'href="appendix-claims.html#c04"' in row
    assert "[episodes](appendix-data.md)" in row
    assert "`bench run --task free-body --regulator rotation-matrix" in row


def test_every_sentence_leads_to_its_evidence():
    sentences = paper_index.facts(RUN)["sentences"]
    assert all(f'href="appendix-claims.html#{claim.id.lower()}"' in sentences for claim in all_claims())


def test_pages_of_chapters_are_named_by_their_numbers():
    assert paper_index.link_page("10-try-it") == "[chapter 10](10-try-it.md)"
    assert paper_index.link_page("appendix-laws") == "[appendix laws](appendix-laws.md)"
    assert (REPORT / "pages" / "10-try-it.md").is_file()


def measured():
    """Return what each law of the redrawn figures does."""
    traces, episodes = responses.drawn(RUN)
    return {end: responses.measure_response(traces, episodes, end, 100.0, 20.0) for end in responses.FIGURES}


def test_axes_of_the_redrawn_figures_hold_every_response():
    found = measured()
    limits = responses.find_limits(list(found.values()))
    for response in found.values():
        assert abs(responses.euler_deg(response.trace)).max() <= limits.euler
        assert response.peak_deg <= limits.goal


def test_body_that_turns_away_at_first_is_said_to_do_so_and_no_other():
    said = {end: responses.describe_finding(response) for end, response in measured().items()}
    assert ["away from the goal" in said[end] for end in ("3", "4", "5")] == [False, False, True]


def test_response_that_never_settles_is_said_to_do_so():
    response = measured()["3"]
    stuck = response._replace(row=response.row.copy())
    stuck.row["outcome"] = "stuck"
    assert "never settles" in responses.describe_finding(stuck)


def operations(*totals):
    """Return operations of the paper's laws."""
    return pd.DataFrame({"flops": totals, "calls": 0}, index=cost.PAPERS_ORDER[: len(totals)])


def test_order_of_costs_is_the_papers_only_if_each_law_costs_more():
    assert "rises in Murphy's order" in cost.describe_order(operations(43, 51, 69))
    assert "does not rise in Murphy's order" in cost.describe_order(operations(43, 69, 51))
    assert "does not rise in Murphy's order" in cost.describe_order(operations(43, 43, 51))
    assert "not tested" in cost.describe_order(operations(43, 51))


def test_laws_are_drawn_in_the_papers_order_and_then_the_later_ones():
    shown = list(cost.count_operations(cost.costs(RUN)).index)
    assert shown[:3] == list(cost.PAPERS_ORDER)
    assert shown[3:] == list(cost.LATER)


POINTS = [
    LawPoint(cost.PAPERS_ORDER[0], 43, 0, 1.7),
    LawPoint(cost.PAPERS_ORDER[1], 45, 6, float("inf")),
    LawPoint(cost.PAPERS_ORDER[2], 63, 6, 0.66),
]


def test_plane_counts_later_laws_that_are_as_fast_and_no_dearer():
    later = [
        LawPoint("mrp", 65, 0, 0.6),
        LawPoint("hybrid", 80, 0, 0.6),
        LawPoint("gibbs", 60, 0, 3.0),
    ]
    assert "1 later law is as fast and takes no more operations" in plane.describe_plane([*POINTS, *later], 1.2)
    assert "No later law is as fast" in plane.describe_plane([*POINTS, later[1]], 1.2)
    assert "Not tested" in plane.describe_plane(POINTS[:2], 1.2)
    assert "None of Murphy's laws" in plane.describe_plane(POINTS, 0.5)
