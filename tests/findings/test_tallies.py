"""Both tallies of the claims, by the present criteria and by the first ones, and what a narrowed run decides."""

import re
import shutil
import tomllib
from collections import Counter

import pytest
from click.testing import CliRunner
from pyarrow import parquet

from bench.base.files import read_json
from bench.cli import claims as command
from bench.findings import claims
from bench.findings.claims.verdict import HISTORY, Claim, Earlier, Evidence, Verdict, Word, does
from bench.studies.verdicts import REFERENCE, STORED
from report.figures.claims import claims as page


def verdict(id, word, *earlier):
    before = tuple(Earlier("2026-11-21 a", "", one) for one in earlier)
    claim = Claim(id, "", "", "", lambda results: None, correction="corrected", instead="else", earlier=before)
    return Verdict(claim, word, Evidence("", 1, ()))


EVERY = [
    verdict("C01", Word.HOLDS),
    verdict("C02", Word.HOLDS, Word.CORRECTED, Word.HOLDS),
    verdict("C03", Word.FAILS, Word.FAILS),
    verdict("C04", Word.DEPENDS, Word.HOLDS),
]


def test_both_tallies_agree_with_the_table_of_claims():
    tiles = re.findall(r"<b>(\d+)</b><span>([^(<]+) \(first criteria: (\d+)\)", page.tiles(EVERY))
    lines = [[cell.strip() for cell in line.split("|")[4:6]] for line in page.table(EVERY).splitlines() if "C0" in line]
    now = [next(word for word in sorted(Word, key=len, reverse=True) if f">{word}<" in cell) for cell, _ in lines]
    first = [Word(was.partition("first: ")[2] or word) for word, (_, was) in zip(now, lines, strict=True)]
    for word in Word:
        told = [(int(n), int(of)) for n, said, of in tiles if said == does(word, int(n))] or [(0, 0)]
        assert told == [(now.count(word), first.count(word))]


def test_both_tallies_of_the_reference_are_those_of_its_words_and_of_the_history():
    words = {id: Word(word) for id, word in read_json(STORED)["reference"].items()}
    every = [Verdict(one, words[one.id], Evidence("", 1, ())) for one in claims.all_claims()]
    history = tomllib.loads(HISTORY.read_text())
    first = Counter(history[id][0]["word"] if id in history else str(word) for id, word in words.items())
    tiles = re.findall(r"<b>(\d+)</b><span>([^(<]+) \(first criteria: (\d+)\)", page.tiles(every))
    expected = {does(word, words_now): first[word] for word, words_now in claims.tally(words.values()).items()}
    assert {said: int(of) for _, said, of in tiles} == expected
    assert sum(first.values()) == len(words) == len(claims.all_claims())


def test_refuted_claims_come_first_and_say_what_is_true():
    rows = [line for line in page.table(EVERY).splitlines() if "C0" in line]
    assert [re.search("C0.", row)[0] for row in rows] == ["C03", "C04", "C01", "C02"]
    assert ["else" in row for row in rows] == [True, True, False, False]


def test_counts_of_words_are_told_in_their_order():
    assert claims.told(one.word for one in EVERY) == "2 hold, 1 does not hold, 1 depends on the gains"


def test_claims_of_a_narrowed_run_lists_what_it_decides_and_what_not(tmp_path):
    for name in ("plan.json", "provenance.json"):
        shutil.copy(REFERENCE / name, tmp_path)
    for path in REFERENCE.glob("*.parquet"):
        rows = parquet.read_table(path)
        parquet.write_table(rows if path.stem == "costs" else rows.slice(0, 3), tmp_path / path.name)
    decided, lacks = claims.judge_possible(claims.Results(tmp_path))
    said = CliRunner().invoke(command.COMMAND, [str(tmp_path)])
    assert said.exit_code == 0
    listed, _, rest = said.output.partition("Not judged")
    assert set(re.findall(r"^C\d\d", listed, re.MULTILINE)) == {one.id for one in decided} != set()
    assert set(re.findall(r"\bC\d\d", rest)) == set(lacks) != set()


@pytest.mark.parametrize("other", [{}, {"C03": "holds"}])
def test_words_at_other_gains_are_told_by_damping_ratio(other):
    study = {"gains": [{"kp": 100.0, "kv": 14.0, "words": other}]}
    said = page.by_gains(study, {"C03": "does not hold"})
    assert ("damping ratio of 0.7: C03 (holds)" in said) == bool(other)
