"""What `show` says of a run in at most 40 lines, whatever is in the run, and the parts it prints in full."""

import re
from collections import Counter

import pandas as pd
import pytest
from rich.console import Console
from support.command_line import bench, python, refused

from bench.cli.details import PARTS, robustness
from bench.cli.details.episodes import tables_of_arms
from bench.cli.options import REFERENCE
from bench.cli.screen import frame_table
from bench.cli.summary import answer, failures
from bench.cli.summary.whole import parts_in
from bench.experiments.tables import read as results
from bench.findings.claims import Results
from bench.findings.selection.needs import measure
from bench.findings.selection.regions import find_default

LINES, COLUMNS = 40, 100


@pytest.fixture(scope="module")
def tables():
    return {name: results.table(REFERENCE, name) for name in ("episodes", "compliance", "robustness", "costs")}


@pytest.fixture(scope="module")
def reference(tables):
    return Results(REFERENCE, dict(tables))


def text(*found) -> str:
    return " ".join(sentence for one in found for sentence in one.sentences)


@pytest.mark.weekly
def test_summary_of_the_reference_fits_the_screen_and_begins_with_the_law(reference):
    """In a process of its own: it judges every claim, which takes memory."""
    lines = python("-m", "bench", "show", REFERENCE).splitlines()
    assert (len(lines) <= LINES, max(map(len, lines)) <= COLUMNS) == (True, True)
    assert lines[0].startswith("Which law ")
    assert f"Use the law {find_default()} (adapted: after" in lines[0]
    for head in ("Elsewhere", "Ours", "Claims", "What failed", "This run", "Next"):
        assert any(line.startswith(head) for line in lines)


def test_summary_of_a_tiny_run_fits_too_says_what_is_not_in_it_and_offers_what_works(capsys, finished, monkeypatch):
    monkeypatch.chdir(finished.parent)
    said = bench(capsys, "show", finished.name)
    lines = said.out.splitlines()
    assert (len(lines) <= LINES, max(map(len, lines)) <= COLUMNS) == (True, True)
    assert lines[0].startswith(f"Which law    Use the law {find_default()}")
    assert "This run cannot compare it" in " ".join(said.out.split())
    assert re.search(r"Not in this run: arms, contact, robustness[^.]* and", said.out)
    assert "settled 0 of 3 episodes" in said.out
    offered = re.findall(r"bench (.*?)   ", said.out)
    assert offered == [f"show {finished.name} --details", f"claims {finished.name}"]
    nexts = [bench(capsys, *words.split()) for words in offered]
    assert {(one.code, "There is nothing" in one.out) for one in nexts} == {(0, False)}
    assert re.search(r"^Not judged {3}C01 cannot be judged from this run: no episode", nexts[-1].out, re.MULTILINE)


def test_laws_of_a_run_without_arms_are_compared(tables):
    episodes, compliance = results.chosen(tables["episodes"], {"arm": ""}), tables["compliance"].iloc[:0]
    found = measure(Results(REFERENCE, {**tables, "episodes": episodes, "compliance": compliance}))
    assert "it is better by" in text(*answer.paragraphs(found))


def test_settled_counts_are_those_of_the_tables(tables, reference):
    episodes = tables["episodes"]
    free_body = episodes[episodes["arm"] == ""]
    settled = (free_body["outcome"] == "settled").sum()
    assert f"Free body: settled {settled:,} of {len(free_body):,} episodes" in text(failures.paragraph(reference))


def test_law_that_broke_is_named(tables):
    lost = tables["episodes"].head(3).assign(outcome=pd.Categorical(["crashed", "hung", "crashed"]))
    law = str(lost["contender"].iloc[0]).partition("@")[0]
    said = text(failures.paragraph(Results(REFERENCE, {**tables, "episodes": lost})))
    assert f"{law} crashed in 2 episodes and {law} hung in 1 episode" in said


@pytest.mark.parametrize("part", ["free-body", "arms", "contact", "robustness"])
def test_part_is_shown_alone_with_the_meaning_of_its_cells(capsys, part):
    said = bench(capsys, "show", REFERENCE, part)
    heads = re.findall(r"^(.*\(a/b: .*)", said.out, re.MULTILINE)
    assert said.code == 0
    assert heads
    assert len(re.findall(r"^(?:law|controller) ", said.out, re.MULTILINE)) == len(heads)
    assert all({"free-body": "free body", "robustness": "robustness"}.get(part, "") in head for head in heads)


def test_details_are_all_parts(capsys, reference):
    whole = bench(capsys, "show", REFERENCE, "--details").out
    for part in parts_in(reference):
        assert bench(capsys, "show", REFERENCE, part).out.split("\n", 1)[1] in whole


def test_part_without_a_folder_is_of_the_usual_run(capsys, monkeypatch):
    monkeypatch.setenv(results.VARIABLE, str(REFERENCE))
    assert bench(capsys, "show", "contact") == bench(capsys, "show", REFERENCE, "contact")


def test_few_perturbations_are_shown_level_by_level(tables):
    rows = tables["robustness"]
    (_, whole), (head, levels) = robustness.tables(rows[rows["axis"] == "half-turn-noise"])
    assert head == "half-turn-noise [rad], level by level (a/b: a of b starts go well)"
    assert list(levels) == ["law", "0", "0.001", "0.01", "0.03", "0.1", "0.3", "1"]
    assert list(levels["law"]) == list(whole["law"])[1:]  # the first line is theory's


def test_part_that_a_run_lacks_is_said_and_an_option_that_a_part_does_not_take_is_refused(capsys, finished):
    said = bench(capsys, "show", finished, "robustness")
    assert said.code == 0
    assert "nothing of robustness in this run" in said.out
    assert "contact takes no --outcomes" in refused(capsys, "show", finished, "contact", "--outcomes")


@pytest.mark.parametrize("words", [("arm",), ("results/reference", "arm")])
def test_unknown_part_is_refused_with_the_parts(capsys, words):
    line = refused(capsys, "show", *words)
    assert ", ".join(PARTS) in line
    assert "try: " in line


def test_names_stay_whole_where_the_table_is_wider_than_the_screen(capsys):
    episodes = results.table(REFERENCE, "episodes")
    for _, table in tables_of_arms(episodes[episodes["arm"] != ""]):
        Console(width=80, highlight=False, markup=False, emoji=False).print(frame_table(table))
    lines = capsys.readouterr().out.splitlines()
    assert max(len(line.rstrip()) for line in lines) <= 80
    assert any(re.match(r"linearized-euler-relative/zyx-euler +\d/\d ", line) for line in lines)
    assert any(line.rstrip() == "  @geometric+pseudo-inverse" for line in lines)


@pytest.mark.parametrize("width", [12, 40, 60])
def test_narrow_screen_shows_every_letter_of_a_table(capsys, width):
    cells = ["damped-least-squares-variable", "Chiaverini, Siciliano, Egeland 1994; Nakamura & Hanafusa 1986", "120.5"]
    table = pd.DataFrame([cells], columns=["name", "source", "median [s]"])
    Console(width=width, highlight=False, markup=False, emoji=False).print(frame_table(table))
    said = capsys.readouterr().out
    assert max(map(len, said.splitlines())) <= width
    assert Counter("".join(cells).replace(" ", "")) <= Counter(said)
