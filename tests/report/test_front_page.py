"""The front page: conclusions and answer as they are judged, the advised law as code, a shared link with a picture."""

import re
import shutil

import pytest
import yaml
from support.pages import RUN
from support.pasted_law import check_command

from bench.base.files import read_json
from bench.base.provenance import ROOT
from bench.experiments.tables.run import run_in
from bench.findings.answer import find_answer
from bench.findings.conclusions import conclude
from bench.law.attribution import IN_WORDS
from report.figures import index
from report.figures.kit import families, html
from report.figures.kit.page import REPORT, text_of
from report.figures.replication import conclusions as replication

BOOK = "".join(path.read_text(encoding="utf-8") for path in REPORT.glob("pages/*.md"))
[CODE] = re.findall(r"```python\n(.*?)```", text_of("index"), re.DOTALL)


def test_code_to_paste_is_the_advised_law_over_random_states():
    shown = {}
    exec(CODE, shown)
    check_command(shown["command"])


def test_front_page_has_the_eight_conclusions_as_they_are_judged():
    rows = index.facts(RUN)["conclusions"].splitlines()[2:]
    conclusions = conclude(RUN)
    assert len(rows) == len(conclusions) == 8
    for row, conclusion in zip(rows, conclusions, strict=True):
        assert f">{conclusion.verdict}</span>" in row
        assert plain(replication.call_laws(conclusion.finding)) in plain(row)
        assert f"({conclusion.section})" in row
        assert f":name: {replication.FIGURES[conclusion.subject]}\n" in BOOK


def plain(text):
    """Return the numbers and words of a text that no typesetting changes."""
    return " ".join(re.findall(r"\d[\d.]*|(?<![<>&/\w-])(?!alpha)[a-z]{4,}(?![\w-])", text))


@pytest.fixture(scope="module")
def without_episodes(tmp_path_factory):
    """Return the published run without its table of episodes."""
    folder = tmp_path_factory.mktemp("removed") / "run"
    shutil.copytree(RUN.folder, folder)
    (folder / "episodes.parquet").unlink()
    return run_in(folder)


def test_conclusions_whose_rows_are_removed_are_not_tested(without_episodes):
    verdicts = {row[0].partition(":**")[0][2:]: row[1] for row in replication.list_in_short(without_episodes)}
    tested = {name for name, verdict in verdicts.items() if html.UNTESTED not in verdict}
    assert len(verdicts) == 8
    assert tested <= {replication.SUBJECTS[name] for name in ("cost", "compliance")}  # these need no episode


def test_abstract_says_what_is_not_tested_if_a_table_is_removed(without_episodes):
    text = index.describe_replication(without_episodes)
    for find, subject in index.FOUND.items():
        if find is not index.describe_statements:
            assert f"{subject} is not tested in this run." in text
    assert "this run does not test" in text


def test_front_page_shows_the_answer_with_its_price_and_every_need():
    answer, shown = find_answer(), index.facts(RUN)
    assert f"laws/{families.anchor(answer.law)}.html" in shown["answer"]
    assert IN_WORDS[answer.attribution] in shown["answer"]
    assert plain(answer.price) in plain(shown["price"])
    rows = shown["needs"].splitlines()[2:]
    assert [f"laws/{families.anchor(need.law)}.html" in row for need, row in zip(answer.needs, rows, strict=True)] == [
        True
    ] * len(answer.needs)
    assert all(f"({need.attribution})" in row for need, row in zip(answer.needs, rows, strict=True))


def test_front_page_says_that_an_answer_without_a_map_is_not_tested(tmp_path):
    answer = find_answer(tmp_path, tmp_path)
    assert "not tested" in index.describe_answer(answer)
    assert "not tested" in index.describe_price(answer)
    assert all("not tested" in " ".join(row) for row in index.list_needs(answer))


def test_byline_names_the_authors_of_the_citation_and_the_commit_of_the_results():
    said = index.facts(RUN)["byline"]
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert all(author["name"] in said for author in cited["authors"])
    assert cited["title"] in text_of("index")
    assert f"Version {cited['version']}" in said
    assert read_json(RUN.folder / "provenance.json")["commit"][:8] in said


@pytest.mark.skipif(not (REPORT / "_build/html/index.html").is_file(), reason="the report is not built")
@pytest.mark.parametrize(("page", "up"), [("index", ""), ("pages/07-which-error", "../"), ("laws/mrp", "../")])
def test_shared_link_has_a_description_and_a_picture(page, up):
    text = (REPORT / f"_build/html/{page}.html").read_text(encoding="utf-8")
    tags = dict(re.findall(r'<meta (?:name|property)="(description|og:\w+)" content="([^"]*)">', text))
    assert tags["og:image"] == f"{up}_static/media/card.png"
    assert tags["og:description"] == tags["description"]
    assert 20 <= len(tags["description"]) <= 202
    assert tags["og:title"]
