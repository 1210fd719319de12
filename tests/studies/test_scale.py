"""The study of many episodes: processes begin before they are measured, and a run is measured as meant."""

from bench.running.schedulers import THREADS
from bench.studies import scale


def test_every_process_begins_before_it_is_measured():
    assert [len(scale.make_smallest_plan(one).units) for one in scale.SCHEDULERS] == [1, 1, 2]
    assert scale.make_smallest_plan("local:2").episodes() == 2


def test_run_is_measured():
    found = scale.measure(THREADS, 300)
    assert (found["scheduler"], found["episodes"]) == (THREADS, 300)
    assert found["own_cpu_s"] > 0.0
    assert found["others"] >= 0.0
    assert found["peak_bytes"] > 5e7
    assert found["row_bytes"] > 10.0
