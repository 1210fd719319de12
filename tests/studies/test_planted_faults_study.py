"""The committed study of the gate: every planted fault is caught and its law named."""

from bench.base.files import read_json
from bench.experiments.tables.schema import RESULTS
from bench.studies.gates import list_faults


def test_every_planted_fault_is_caught_and_named_and_nothing_else_is():
    nothing, *planted = read_json(RESULTS / "regress" / "faults.json")["rows"]
    assert (nothing["caught"], nothing["law"]) == (False, "")
    assert [one["fault"] for one in planted] == [one.title for one in list_faults()[1:]]
    assert all(one["caught"] and one["named"] and not one["others_blamed"] for one in planted)
