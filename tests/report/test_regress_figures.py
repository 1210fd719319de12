"""The page on the gate: its numbers follow from the rows, and what is committed holds what the page says."""

import pandas as pd
import pytest

from bench.studies.gates import faults, same_code
from bench.studies.gates.load import MOST
from bench.tables.schema import RESULTS
from report.figures.kit.page import Run
from report.figures.tool import regressions

COMMITTED = Run(RESULTS)


def test_study_if_it_was_run_has_all_its_comparisons_and_no_false_alarm():
    if not regressions.part(COMMITTED, "same_code"):
        pytest.skip("results/regress/same_code.json is not there: python -m bench.studies.gates")
    verdicts = regressions.verdicts(COMMITTED)
    assert verdicts["comparison"].nunique() == same_code.COMPARISONS == 50
    assert len(verdicts) == verdicts["comparison"].nunique() * verdicts["benchmark"].nunique()
    assert verdicts["neighbours"].between(0, sum(MOST.values())).all()
    assert not verdicts["alarm"].any()


def test_every_planted_fault_is_caught_and_named_and_nothing_else_is():
    nothing, *planted = regressions.part(COMMITTED, "faults")
    assert (nothing["caught"], nothing["law"]) == (False, "")
    assert len(planted) == len(faults.behaviour()) + 1
    assert all(one["caught"] and one["named"] and not one["others_blamed"] for one in planted)


MADE = pd.DataFrame(
    {
        "comparison": [1, 1, 2, 2],
        "neighbours": [0, 0, 3, 3],
        "benchmark": ["a", "b", "a", "b"],
        "ratio": [1.0, 1.2, 1.3, 0.9],
        "p": [0.5, 1e-4, 1e-5, 1e-3],
        "doubted": [False, True, True, False],
        "alarm": [False, False, True, False],
    }
)
STEPS = pd.DataFrame(
    {
        "steps": [None, 1, 3],
        "slower": [0.0, 0.09, 0.2],
        "repeats": [16, 16, 16],
        "once": [0.0, 0.5, 1.0],
        "twice": [0.0, 0.25, 1.0],
        "instructions": [0.0, 0.02, 0.05],
    }
)


def test_sentences_count_doubts_and_alarms():
    said = regressions.noise(MADE, pd.Series([-2e-6, 1e-6]))
    assert "By p alone 2 comparisons would have rung" in said
    assert "both conditions held for 2 benchmarks in 2 of them, and the second run confirmed 1" in said
    assert "2 pairs, differed by 2·10⁻⁶ at most" in said
    faults = [{"law": "a", "caught": True, "named": is_named} for is_named in (True, False)]
    assert "2 times on a busy machine: 1 false alarms. Of 2 planted faults 1" in regressions.lead(MADE, faults)


def test_sentences_say_what_a_tenth_looks_like():
    said = regressions.found(STEPS)
    assert "9 % slower is found in 50 % of single runs and in 25 % of pairs of runs; it has 2.0 % more" in said
    assert "Time is sure from 20 % on. Instructions tell from 9 % on." in said


def test_page_without_a_study_has_only_the_numbers_of_the_rule(tmp_path):
    none = Run(tmp_path, studies=tmp_path)
    assert {key for key, value in regressions.facts(none).items() if value is None} == {"lead", "noise", "found"}
    assert not any(regressions.tables(none).values())


def test_table_escapes_the_words_of_findings():
    rows = [{"fault": "one", "law": "a", "gates": ["exact"], "says": ["a: 1 -> 2 | <b>"]}]
    table = regressions.FAULTS(map(regressions.fault, rows))
    assert "<b>" not in table
    assert table.count("|") == 3 * 5
