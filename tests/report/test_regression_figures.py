"""The page on regressions: its numbers follow from the rows, and what is committed holds what the page says."""

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make report)")

from bench.experiments.tables.schema import RESULTS
from bench.studies.gates import COMPARISONS, list_faults
from report.figures.kit.page import Run
from report.figures.tool import regressions

COMMITTED = Run(RESULTS)


def test_study_if_it_was_run_has_all_its_comparisons_and_no_false_alarm():
    rows = regressions.read_rows(COMMITTED, "same_code")
    if not rows:
        pytest.skip("results/regress/same_code.json is not there: python -m bench.studies.gates")
    assert len(rows) == COMPARISONS
    assert not any(one["alarms"] for one in rows)


def test_every_planted_fault_is_caught_and_named_and_nothing_else_is():
    nothing, *planted = regressions.read_rows(COMMITTED, "faults")
    assert (nothing["caught"], nothing["law"]) == (False, "")
    assert [one["fault"] for one in planted] == [one.title for one in list_faults()[1:]]
    assert all(one["caught"] and one["named"] and not one["others_blamed"] for one in planted)


def test_page_without_a_study_has_only_the_numbers_of_the_rule(tmp_path):
    facts = regressions.facts(Run(tmp_path, studies=tmp_path))
    assert {key for key, value in facts.items() if value is not None} == {"p", "ratio", "rounds"}
