"""The study of many episodes: what is committed holds, its page follows from it, a run is measured as meant."""

import copy

import pytest

from bench.running.schedulers.words import THREADS
from bench.studies import scale

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from report.figures.tool import clusters

EACH_US = {10**3: 240.0, 10**4: 200.0, 10**5: 210.0, 10**6: 218.0}


def made(scheduler, episodes, each_us, processes=1, own=1.0):
    """A run as the study writes it, whose processes never wait; own: its command's share of the CPU time."""
    cpu_s = 1e-6 * each_us * episodes
    return {
        "law": "rotation-matrix",
        "scheduler": scheduler,
        "episodes": episodes,
        "cpu_s": cpu_s,
        "own_cpu_s": own * cpu_s,
        "wall_s": cpu_s / processes,
        "others": 0.02,
        "peak_bytes": 400e6 + 50 * episodes,
        "row_bytes": 230.0,
        "rows": f"digest of {episodes}",
    }


@pytest.fixture
def found():
    """A study in which all is well: 9 % more an episode, memory flat, the same rows."""
    tables = {"episodes.parquet": "a", "traces.parquet": "b"}
    by = ("threads", "local:2", "local:2, a worker killed")
    return {
        "sizes": [made(THREADS, number, shift * each) for shift in (0.9, 1.0, 1.1) for number, each in EACH_US.items()],
        "schedulers": [
            made(THREADS, 10**5, 200.0),
            made("local:1", 10**5, 250.0, own=0.1),
            made("local:2", 10**5, 250.0, processes=2, own=0.1),
        ],
        "killed": {"units": 78, "killed": 1, "same": True, "tables": {name: dict(tables) for name in by}},
        "provenance": {"sizes": {"cpu": "Any Processor", "cores": 2}},
    }


def test_committed_study_has_the_same_rows_whoever_made_them():
    study = clusters.study()
    if not study:
        pytest.skip("results/scale/scale.json is not there: make scale-study")
    assert [one["scheduler"] for one in study["schedulers"]] == list(scale.SCHEDULERS)
    assert {one["episodes"] for one in study["sizes"]} == set(scale.ORDER)
    for episodes in EACH_US:
        runs = [one for one in (*study["sizes"], *study["schedulers"]) if one["episodes"] == episodes]
        assert len({one["rows"] for one in runs}) == 1
    assert clusters.tables_apart(study) == []
    assert (study["killed"]["killed"], len(study["killed"]["tables"])) == (1, 3)
    text = clusters.FILE.read_text()
    assert "tcp://" not in text
    assert str(scale.ROOT) not in text


def test_page_says_that_what_was_asked_for_is_met(found):
    text = clusters.text(found)
    cost = text["cost"]
    assert "an episode costs 218 µs, in one of 10⁴ 200 µs: +9 %, at most a tenth more" in cost
    assert "3 runs of 10⁴, before the largest and after it, lie between 180 and 220 µs" in cost
    assert "50 bytes for each episode more" in text["memory"]
    assert "Memory is flat" in text["memory"]
    assert "All 2 tables have the same bytes." in text["same"]


def test_page_says_that_what_was_asked_for_is_not_met(found):
    worse = copy.deepcopy(found)
    for one in worse["sizes"]:
        if one["episodes"] == 10**6:
            one["cpu_s"] *= 1.05
            one["peak_bytes"] *= 1.25
    worse["killed"]["tables"]["local:2"]["traces.parquet"] = "c"
    text = clusters.text(worse)
    assert "**over** a tenth more" in text["cost"]
    assert "Memory is **not** flat" in text["memory"]
    assert "These tables differ: traces.parquet." in text["same"]


def test_efficiency_is_one_thread_s_time_over_that_of_all_processes(found):
    schedulers = clusters.schedulers(found)
    assert schedulers["by_wall"].tolist() == pytest.approx([1.0, 0.8, 0.8])
    said = clusters.text(found)["efficiency"]
    assert "80 % with one process and 80 % with two. Other programs took 0.02 cores at most meanwhile." in said
    assert "25 µs are the client's" in said
    assert "some 9 processes busy" in said


def test_study_of_very_many_is_computed_from_the_largest_run_and_two_processes(found):
    said = clusters.text(found)["study"]
    hours = 1e9 * 218e-6 / 0.8 / 3600
    assert f"10⁹ episodes take {hours:.0f} core-hours: {60 * hours / 1000:.0f} minutes" in said
    assert "Rows take 230 GB" in said
    assert f"{hours:.0f} core-hours" in clusters.text(found)["lead"]


def test_table_has_a_row_for_every_size(found):
    assert len(clusters.by_size(found).splitlines()) == 2 + len(EACH_US)


def test_page_says_nothing_of_what_was_not_run():
    assert (clusters.text({}), clusters.by_size({})) == ({}, None)


def test_every_process_begins_before_it_is_measured():
    assert [len(scale.least(one).units) for one in scale.SCHEDULERS] == [1, 1, 2]
    assert scale.least("local:2").episodes() == 2


def test_run_is_measured():
    found = scale.measured(THREADS, 300)
    assert (found["scheduler"], found["episodes"]) == (THREADS, 300)
    assert found["own_cpu_s"] > 0.0
    assert found["others"] >= 0.0
    assert found["peak_bytes"] > 5e7
    assert found["row_bytes"] > 10.0
