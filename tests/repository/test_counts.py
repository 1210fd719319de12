"""One number, one place: what pages compute and what prose says by hand are the numbers of `findings.counts`."""

import re
from pathlib import Path

import numpy as np
import pytest

from bench.findings.counts import AT_REST, counts, orientations
from bench.tables import read
from bench.tables.schema import RESULTS
from report.figures.comparison import comparison, directed
from report.figures.failures import failure_map
from report.figures.kit.page import run_in
from report.figures.libraries import libraries
from report.figures.responses import settling_time
from report.figures.robustness import robustness

ROOT = Path(__file__).resolve().parents[2]
RUN = run_in(RESULTS / "reference")

FEW = 4
"""A number in words that is less, of what there are more, counts a part: two laws, three of the arms."""

TEENS = "four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen eighteen nineteen"
WORDS = dict(enumerate(f"two three {TEENS} twenty".split(), 2))
NUMBER = rf"(?P<number>\d[\d,]*|{'|'.join(WORDS.values())})"

PROSE = {
    rf"{NUMBER} (?:other |robot )*libraries": {"libraries"},
    rf"{NUMBER} (?:manipulators|arms)\b": {"arms"},
    rf"{NUMBER} later laws": {"later"},
    rf"{NUMBER} negative controls": {"controls"},
    rf"{NUMBER} exact half turns": {"half-turns"},
    rf"{NUMBER} (?:of the paper's )?(?:claims|statements|sentences)\b": {"claims"},
    rf"(?:all|of|beside|under|each of the) {NUMBER} laws": {"laws", "continuous", "papers"},
}
"""What prose counts -> the counts that it may be."""

FACTS = {
    (comparison, "laws"): "continuous",
    (comparison, "directed"): "orientations",
    (comparison, "half_turns"): "half-turn-starts",
    (settling_time, "exact"): "half-turns",
    (robustness, "axes"): "perturbations",
    (libraries, "libraries"): "libraries",
}
"""Facts of pages -> what they count."""


@pytest.fixture(autouse=True)
def reference(monkeypatch):
    monkeypatch.setenv(read.VARIABLE, str(RESULTS / "reference"))


def said(text: str):
    """(what is said, its number, the counts it may be) of every place in a text that counts something."""
    plain = " ".join(text.split())
    values = {word: number for number, word in WORDS.items()}
    for pattern, names in PROSE.items():
        for one in re.finditer(pattern, plain, re.IGNORECASE):
            word = one["number"].lower().replace(",", "")
            yield one[0], values.get(word) or int(word), names


def wrong(text: str) -> list[str]:
    """What is said of numbers that are none of the counts."""
    found = ((phrase, number, {counts()[name].number for name in names}) for phrase, number, names in said(text))
    return [phrase for phrase, number, right in found if number not in right and number >= min(FEW, *right)]


def pages() -> list[Path]:
    return [ROOT / "report" / "index.md", *sorted((ROOT / "report" / "pages").glob("*.md"))]


@pytest.mark.parametrize("path", [ROOT / "README.md", *pages()], ids=lambda path: path.name)
def test_numbers_in_prose_are_the_counts(path):
    assert wrong(path.read_text(encoding="utf-8")) == []


def test_numbers_in_the_changelog_of_what_is_unreleased_are_the_counts():
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert wrong(text.partition("## [Unreleased]")[2].partition("\n## ")[0]) == []


def test_prose_is_found_and_a_wrong_number_with_it():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert list(said(text))
    assert wrong("nineteen\nmanipulators, 22 robot libraries") == ["22 robot libraries", "nineteen manipulators"]


@pytest.mark.parametrize(("page", "fact"), FACTS, ids=lambda one: getattr(one, "__name__", one))
def test_facts_of_pages_are_the_counts(page, fact):
    assert int(page.facts(RUN)[fact]) == counts()[FACTS[page, fact]].number


def test_exact_half_turns_are_as_many_in_both_tables_of_exact_points():
    tables = [
        {(place, tried) for law, place, tried, *_ in failure_map.exact_points(failure_map.continuous(RUN))},
        set(
            directed.directed(comparison.ideal(RUN))
            .groupby("contender", observed=True)["place"]
            .value_counts()["rotation-matrix"]
            .items()
        ),
    ]
    assert {one for one in tables[0] if "half turn" in one[0]} == {one for one in tables[1] if "half turn" in one[0]}


def test_orientations_of_directed_starts_are_those_of_the_run():
    rows = directed.directed(comparison.ideal(RUN))
    own = failure_map.orientation(rows[rows["contender"] == "rotation-matrix"]).to_numpy()
    assert set(rows["start_set"].astype(str)) <= set(AT_REST)
    np.testing.assert_allclose(np.unique(own + 0.0, axis=0), orientations(), rtol=0.0, atol=2e-13)
