"""The measured value of each claim on the reference run: short, with a number, and the rows behind it."""

import re

import pandas as pd
import pytest

from bench.base.files import read_json
from bench.experiments.tables.run import Run, query_of
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.statistics import Estimate
from bench.findings import claims
from bench.findings.amounts import part_of
from bench.findings.claims.at_gains import at_every_gain
from bench.findings.claims.performance import is_without_memory, whose
from bench.findings.claims.tables import interval_or_never, percent, share
from bench.findings.claims.verdict import LONGEST_MEASURED, Claim, Evidence, Verdict, Word
from bench.findings.selection.regions import find_default
from bench.law.inputs import Gains

REFERENCE = RESULTS / "reference"
ZERO_OR_ALL = re.compile(r"\b0 of (the )?\d|\b([\d,]+) of (the )?\2\b(?![,.]\d)")
"""R4 of the book's language: zero is 'no' or 'none', all is 'all'."""


@pytest.fixture(scope="module")
def verdicts():
    decided, lacks = claims.judge_possible(Run(REFERENCE))
    assert not lacks
    return {verdict.id: verdict for verdict in decided}


@pytest.mark.slow
def test_every_claim_of_the_reference_has_a_short_measured_value_with_a_number(verdicts):
    assert len(verdicts) == len(claims.all_claims())
    for verdict in verdicts.values():
        measured = verdict.evidence.measured
        assert re.search(r"\d", measured), verdict.id
        assert len(measured) <= LONGEST_MEASURED, (verdict.id, measured)
        assert not re.search(r"\b(inf|nan)\b", measured), (verdict.id, measured)


@pytest.mark.slow
def test_evidence_says_none_and_all_and_never_infinity(verdicts):
    for verdict in verdicts.values():
        evidence = verdict.evidence
        texts = evidence.sentence, evidence.instead, evidence.measured, *sum(evidence.numbers, ())
        for text in texts:
            assert not ZERO_OR_ALL.search(text), (verdict.id, text)
            assert not re.search(r"\binf\b|\d%", text), (verdict.id, text)


@pytest.mark.slow
def test_rows_behind_a_claim_are_those_that_its_condition_chooses(verdicts):
    tables: dict[str, pd.DataFrame] = {}
    for verdict in verdicts.values():
        for name, condition in verdict.evidence.chosen:
            assert name in verdict.evidence.tables
            frame = tables.setdefault(name, pd.read_parquet(REFERENCE / f"{name}.parquet"))
            rows = frame.query(condition) if condition else frame
            assert len(rows), (verdict.id, name, condition)


@pytest.mark.slow
def test_open_question_is_answered_by_the_default_law_among_others(verdicts):
    answer = verdicts["C27"]
    passing = {row[0] for row in answer.evidence.numbers[1:] if row[2] == "passes"}
    default = find_default()
    assert answer.word == Word.ANSWERED
    assert default in passing
    assert answer.correction.startswith("These laws pass all eight tests and so answer the open question: ")
    assert all(f"{law} ({whose(law)})" in answer.correction for law in passing)
    assert ("A law without memory cannot" in answer.correction) == (not any(map(is_without_memory, passing)))


@pytest.mark.slow
def test_words_of_the_study_are_of_the_reference_but_for_what_is_stale(verdicts):
    study = read_json(RESULTS / "verdicts" / "verdicts.json")
    for id, word in study["reference"].items():
        assert id in study.get("stale", []) or word == str(verdicts[id].word)


def test_claim_without_data_is_not_tested():
    claim = Claim("C00", "", "", "", judge=lambda results: None)
    assert Verdict(claim, Word.UNTESTED, Evidence("", 1)).measured == "not tested"


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (1.0, "100"), (0.9997, "99.97"), (0.931, "93.1"), (0.0646, "6.46"), (0.00058, "0.058")],
)
def test_share_is_written_to_three_figures_and_is_100_only_if_it_is_all(value, text):
    assert percent(value) == text


def test_share_has_its_interval():
    assert f"{share(pd.Series([True] * 931 + [False] * 69))}" == "93.1 % (n = 1,000; 95 % interval: 91.4 to 94.5 %)"


@pytest.mark.parametrize(("part", "text"), [(0, "none of 4"), (3, "3 of 4"), (4, "all 4")])
def test_none_and_all_are_words(part, text):
    assert part_of(part, 4) == text


def test_time_that_is_never_reached_is_no_number():
    assert interval_or_never(Estimate(float("inf"), 1.0, float("inf")), ".2f", " s") == "never"
    assert interval_or_never(Estimate(1.0, 0.5, float("inf")), ".2f", " s") == "1.00 s (0.50 to never)"


def test_condition_chooses_rows_by_one_word_or_some():
    frame = pd.DataFrame({"regulator": ["a", "a", "b"], "start_set": ["box", "poles", "box"]})
    condition = query_of({"regulator": "a", "start_set": ("box", "goals")})
    assert frame.query(condition).index.tolist() == [0]


class OfGains(Run):
    """A run of which only the gains are known."""

    def __init__(self, kv):
        super().__init__(None)
        self.kv = kv

    def gains(self):
        return Gains(100.0, self.kv)


def test_measured_value_is_of_the_run_s_gains_and_names_those_with_another_word():
    def decide(run):
        word = Word.HOLDS if run.kv == 20.0 else Word.FAILS
        numbers = (("Law", "Time"), ("a", f"{run.kv:g} s"))
        return word, Evidence("", 1, measured=f"{run.kv:g} starts.", numbers=numbers)

    own = OfGains(20.0)
    own.others = [OfGains(10.0)]
    _, evidence = at_every_gain(decide)(own)
    assert evidence.measured == "At Kp = 100, Kd = 20: 20 starts. At Kp = 100, Kd = 10, the claim does not hold."
    assert evidence.numbers == (
        ("Gains", "Law", "Time"),
        ("Kp = 100, Kd = 10", "a", "10 s"),
        ("Kp = 100, Kd = 20", "a", "20 s"),
    )
