"""The paper's claims: all present with their texts; errata; tallies of their words; what a narrowed run decides."""

import re
import shutil
import subprocess
import sys
import tomllib
from collections import Counter

import pandas as pd
import pytest
from click.testing import CliRunner
from pyarrow import parquet

from bench.base.errors import NoEvidence
from bench.base.files import read_json
from bench.base.provenance import ROOT
from bench.cli import claims as command
from bench.cli.summary.paper import count_verdicts
from bench.experiments.tables.run import Run
from bench.findings import claims
from bench.findings.claims import at_gains
from bench.findings.claims.errata import COVERAGE, ERRATA, UNTESTABLE
from bench.findings.claims.tables import share
from bench.findings.claims.verdict import (
    HISTORY,
    Claim,
    Earlier,
    Evidence,
    Verdict,
    Word,
    decide,
    read_texts,
)
from bench.studies.verdicts import REFERENCE, STORED
from report.figures.claims import claims as page
from report.figures.claims.places import read_places


def test_every_claim_is_there_once():
    assert [one.id for one in claims.all_claims()] == [f"C{i:02d}" for i in range(1, 48)]
    assert set(read_texts(HISTORY)) <= {one.id for one in claims.all_claims()}


@pytest.mark.parametrize("one", claims.all_claims())
def test_claim_has_its_texts_and_its_judge(one):
    assert all((one.section, one.sentence, one.judge, one.quote, one.value))
    assert "does not hold" in one.criterion or "answered since" in one.criterion
    assert bool(one.correction) == ("with a correction" in one.criterion)
    assert not any(mark in text for text in (one.quote, one.criterion, one.open) for mark in ("{", "\n"))


@pytest.mark.parametrize("one", claims.all_claims())
def test_criterion_and_those_before_it_name_a_commit_of_their_date(one):
    dates = [when.split() for when in (*(old.written for old in one.earlier), one.written)]
    assert [date for date, _ in dates] == sorted(date for date, _ in dates)
    for date, commit in dates:
        asked = ["git", "-C", str(ROOT), "log", "-1", "--format=%as", commit, "--"]
        found = subprocess.run(asked, capture_output=True, text=True, check=False)
        assert found.returncode or found.stdout.strip() == date  # a shallow clone may lack it


def test_verdict_on_no_rows_is_an_error():
    nothing = Evidence("all of none", 0, ("episodes",))
    with pytest.raises(NoEvidence, match="C00: no row of episodes"):
        decide(Claim("C00", "", "", "", judge=lambda results: (Word.HOLDS, nothing)), None)


def test_share_has_wilsons_interval_and_none_of_no_rows():
    # Newcombe 1998, Statistics in Medicine 17, 857-872, table I: 81 of 263
    found = share(pd.Series([True] * 81 + [False] * 182))
    assert (found.low, found.high) == pytest.approx((0.2553, 0.3662), abs=5e-5)
    with pytest.raises(NoEvidence):
        share(pd.Series([], dtype=bool))


@pytest.mark.parametrize("one", [one for one in ERRATA if one.check])
def test_erratum_is_confirmed(one):
    assert one.check()


def test_errata_are_numbered_and_complete():
    assert [one.id for one in ERRATA] == [f"E{i:02d}" for i in range(1, len(ERRATA) + 1)]
    assert all(one.where and one.printed and one.right and one.how for one in ERRATA)
    assert all(one["section"] and one["quote"] and one["why"] for one in UNTESTABLE)


NUMBERED = [
    *(f"(2.{i})" for i in range(1, 17)),
    *(f"Figure 2.{i}" for i in range(1, 6)),
    *(f"(3.{i})" for i in range(1, 13)),
]
"""Equations and figures that the paper numbers."""


def test_every_numbered_equation_and_figure_has_its_place():
    ids = {one.id for one in (*claims.all_claims(), *ERRATA)}
    names = [one.paper for one in COVERAGE]
    assert [name for name in names if name in NUMBERED] == NUMBERED
    assert len(set(names)) == len(names)
    pages = tomllib.loads((ROOT / "report" / "subjects.toml").read_text(encoding="utf-8"))
    for one in COVERAGE:
        assert set(one.claims) <= ids
        assert one.subjects
        assert set(one.subjects) <= pages.keys()


def verdict(id, section, word, *earlier, measured="3 of 4 starts"):
    before = tuple(Earlier("2026-11-21 a", "", one) for one in earlier)
    claim = Claim(id, section, "It settles.", "", lambda results: None, "", instead="else", earlier=before)
    return Verdict(claim, word, Evidence("", 1, (), measured=measured))


EVERY = [
    verdict("C01", "2.4", Word.HOLDS),
    verdict("C02", "2.2 against 3.3", Word.HOLDS, Word.CORRECTED, Word.HOLDS),
    verdict("C03", "4", Word.FAILS, Word.FAILS),
    verdict("C04", "abstract", Word.DEPENDS, Word.HOLDS),
    verdict("C05", "2.4", Word.UNTESTED, measured=""),
]
ROWS = [line for line in page.table(EVERY).splitlines() if "C0" in line]
CELLS = [[cell.strip() for cell in row.strip("|").split(" | ")] for row in ROWS]
"""The table's rows and their cells: claim, statement, verdict, measured value, where it is shown."""


def test_table_of_claims_has_both_words_of_each():
    cells = [row[2] for row in CELLS]
    now = [next(word for word in sorted(Word, key=len, reverse=True) if f">{word}<" in cell) for cell in cells]
    earlier = [cell.partition("first verdict: ")[2].rstrip(")") for cell in cells]
    first = [Word(before or word) for word, before in zip(now, earlier, strict=True)]
    assert Counter(zip(now, first, strict=True)) == Counter((one.word, one.first) for one in EVERY)


def test_first_words_of_the_reference_are_those_of_the_history():
    words = {id: Word(word) for id, word in read_json(STORED)["reference"].items()}
    every = [Verdict(one, words[one.id], Evidence("", 1, ())) for one in claims.all_claims()]
    history = tomllib.loads(HISTORY.read_text())
    first = Counter(history[id][0]["word"] if id in history else str(word) for id, word in words.items())
    assert Counter(str(one.first) for one in every) == first
    assert sum(first.values()) == len(words) == len(claims.all_claims())


def test_no_cell_is_empty_and_what_is_refuted_has_what_is_true():
    assert all(cell for row in CELLS for cell in row)
    assert ["else" in row[3] for row in CELLS] == [False, False, True, True, False]
    assert [row[3] == "not tested" for row in CELLS] == [False, False, False, False, True]


def test_claims_are_sorted_as_the_paper_has_them():
    ordered = sorted(EVERY, key=lambda verdict: verdict.claim.paper_order)
    assert [verdict.id for verdict in ordered] == ["C04", "C02", "C01", "C05", "C03"]


def test_square_of_each_claim_says_its_verdict_and_leads_to_it():
    tiles = page.draw_tiles(EVERY)
    for verdict in EVERY:
        assert f'href="#{verdict.id.lower()}" title="{verdict.id}: {verdict.word}"' in tiles
    assert "5 claims in the order of the paper: 2 hold, 1 does not hold" in tiles
    assert len(set(page.LOOKS.values())) >= len(Word) - 1  # not testable and not tested are one


def test_every_claim_leads_to_a_figure_or_to_its_own_evidence():
    places = read_places()
    assert set(places) <= {claim.id for claim in claims.all_claims()}
    assert page.describe_places("C06").startswith("{numref}`fig-")
    unplaced = next(claim.id for claim in claims.all_claims() if claim.id not in places)
    assert page.describe_places(unplaced) == f'<a href="#{unplaced.lower()}">its evidence</a>'


def test_claim_that_a_run_lacks_is_not_tested_and_says_why(monkeypatch):
    monkeypatch.setattr(claims, "judge_possible", lambda *_: (EVERY[:1], {"C02": "no row of episodes"}))
    monkeypatch.setattr(claims, "all_claims", lambda paper: tuple(verdict.claim for verdict in EVERY[:2]))
    there, lacking = claims.judge_each(None)
    assert (there.word, lacking.word) == (Word.HOLDS, Word.UNTESTED)
    assert lacking.measured == "not tested"
    assert "no row of episodes" in str(lacking.evidence)


def test_counts_of_words_are_told_in_their_order():
    assert claims.told(one.word for one in EVERY) == (
        "2 hold, 1 does not hold, 1 depends on the gains, 1 is not tested"
    )


@pytest.mark.slow
def test_run_of_two_starts_a_set_judges_no_claim_about_episodes(tmp_path):
    whole = ("plan.json", "provenance.json", "costs.parquet", "probes.parquet")  # no count narrows the last two
    for name in whole:
        shutil.copy(REFERENCE / name, tmp_path)
    for path in set(REFERENCE.glob("*.parquet")) - {REFERENCE / name for name in whole}:
        rows, sets = parquet.read_table(path), ("regulator", "representation", "arm", "engine", "start_set")
        by = [name for name in sets if name in rows.column_names] or rows.column_names[0]
        parquet.write_table(
            rows.take([*rows.to_pandas().groupby(by, observed=True).head(2).index]), tmp_path / path.name
        )
    decided, lacks = claims.judge_possible(results := Run(tmp_path))
    assert not [one.id for one in decided if "episodes" in one.evidence.tables]
    assert "fewer starts than the claim needs (2 of 1,000 uniform, 2 of 238 half-turn" in lacks["C01"]
    assert f"{len(lacks)} cannot be judged from this run" in count_verdicts(results)
    said = CliRunner().invoke(command.COMMAND, [str(tmp_path)])
    assert said.exit_code == 0
    listed, _, rest = said.output.partition("Not judged")
    assert set(re.findall(r"^C\d\d", listed, re.MULTILINE)) == {one.id for one in decided} != set()
    assert set(re.findall(r"\bC\d\d", rest)) == set(lacks) != set()


JUDGED = """
import sys
from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.findings import claims

for paper in claims.PAPERS:
    run = Run(RESULTS / "reference")
    _, lacks = claims.judge_possible(run, paper)
    assert not lacks, lacks
print(*(name for name in sys.modules if name.startswith(("bench.engines", "bench.experiments.probes"))))
print(*(name for name in sys.modules if name in ("numba", "llvmlite", "scipy.stats", "scipy.optimize")))
"""


def test_judging_imports_no_engine_no_probe_and_no_statistics_of_scipy():
    command = [sys.executable, "-c", JUDGED]
    ended = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    assert ended.stdout.split() == []


def test_claims_without_the_probes_are_not_judged_and_the_run_s_lack_is_named(tmp_path):
    for path in REFERENCE.iterdir():
        if path.name != "probes.parquet":
            shutil.copy(path, tmp_path)
    results = Run(tmp_path)
    for id in ("C02", "C13", "C44"):
        with pytest.raises(NoEvidence, match="no row of the probe"):
            claims.judge(id, results)
    assert claims.judge("C06", results).word == Word.CORRECTED


@pytest.mark.parametrize("other", [{}, {"C03": "holds"}])
def test_words_at_other_gains_are_told_by_damping_ratio(other):
    study = {"gains": [{"kp": 100.0, "kv": 14.0, "words": other}]}
    said = at_gains.by_gains(study, {"C03": "does not hold"})
    assert ("damping ratio of 0.7, and these change: C03 (holds)" in said) == bool(other)
