"""The committed study of the gate: no false alarm, and every planted fault is caught and its law named."""

import pytest

from bench.base.files import read_json
from bench.experiments.tables.schema import RESULTS
from bench.studies.gates import COMPARISONS, list_faults

FOLDER = RESULTS / "regress"


def test_study_if_it_was_run_has_all_its_comparisons_and_no_false_alarm():
    if not (FOLDER / "same_code.json").is_file():
        pytest.skip("results/regress/same_code.json is not there: python -P -m bench.studies.gates")
    rows = read_json(FOLDER / "same_code.json")["rows"]
    assert len(rows) == COMPARISONS
    assert not any(one["alarms"] for one in rows)


def test_every_planted_fault_is_caught_and_named_and_nothing_else_is():
    nothing, *planted = read_json(FOLDER / "faults.json")["rows"]
    assert (nothing["caught"], nothing["law"]) == (False, "")
    assert [one["fault"] for one in planted] == [one.title for one in list_faults()[1:]]
    assert all(one["caught"] and one["named"] and not one["others_blamed"] for one in planted)
