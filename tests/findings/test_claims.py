"""The paper's claims: all present with their texts, refused without rows; shares, and the errata."""

import subprocess

import pandas as pd
import pytest

from bench.base.provenance import ROOT
from bench.findings import claims
from bench.findings.claims.errata import ERRATA, UNTESTABLE
from bench.findings.claims.tables import share
from bench.findings.claims.verdict import HISTORY, Claim, Evidence, NoEvidence, Word, decide, read_texts


def test_every_claim_is_there_once():
    assert [one.id for one in claims.all_claims()] == [f"C{i:02d}" for i in range(1, 36)]
    assert set(read_texts(HISTORY)) <= {one.id for one in claims.all_claims()}


@pytest.mark.parametrize("one", claims.all_claims(), ids=lambda one: one.id)
def test_claim_has_its_texts_and_its_judge(one):
    assert all((one.section, one.sentence, one.judge, one.quote, one.value))
    assert "does not hold" in one.criterion or "answered since" in one.criterion
    assert bool(one.correction) == ("with a correction" in one.criterion)
    assert not any(mark in text for text in (one.quote, one.criterion, one.open) for mark in ("{", "\n"))


def test_criterion_has_the_numbers_of_its_module():
    assert "at most 0.1% of the uniform ones" in claims.all_claims()[0].criterion


@pytest.mark.parametrize("one", claims.all_claims(), ids=lambda one: one.id)
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


def test_share_has_wilsons_interval():
    # Newcombe 1998, Statistics in Medicine 17, 857-872, table I: 81 of 263
    found = share(pd.Series([True] * 81 + [False] * 182))
    assert (found.low, found.high) == pytest.approx((0.2553, 0.3662), abs=5e-5)


def test_share_of_no_rows_is_an_error():
    with pytest.raises(NoEvidence):
        share(pd.Series([], dtype=bool))


@pytest.mark.parametrize("one", [one for one in ERRATA if one.check], ids=lambda one: one.id)
def test_erratum_is_confirmed(one):
    assert one.check()


def test_errata_are_numbered_and_complete():
    assert [one.id for one in ERRATA] == [f"E{i:02d}" for i in range(1, len(ERRATA) + 1)]
    assert all(one.where and one.printed and one.right and one.how for one in ERRATA)
    assert all(one.section and one.quote and one.why for one in UNTESTABLE)
