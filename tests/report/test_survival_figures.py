"""The page on survival: its tables count what the study found, and what is committed found every run the same."""

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make report)")

from studies.kill_study import KILLS, LAWS, LEFT_KB, SHARES

from bench.tables.schema import RESULTS
from report.figures.kit.page import Run
from report.figures.tool import survival


def kill(what="threads", by="threads", units=0, tables=0, same=True):
    done = {"units_done": units, "tables_done": tables, "left_s": 0.2 if what == "local:2" else None}
    return {"killed": what, "goes_on_by": by, "went_on": True, "same": same, **done}


MADE = {
    "provenance": {"wall_s": 300, "cpu": "A|B", "cores": 2, "commit": "0" * 40},
    "units": 8,
    "tables": 7,
    "kills": [
        *(kill(), kill(units=3), kill(units=8, same=False), kill(tables=2)),
        *(kill("local:2", "local:2", units=1), kill("local:2", units=8, tables=1), kill("worker", "itself", units=2)),
    ],
    "disks": [
        {"left_kb": 12, "failed_at": "a" * 16 + ".parquet", "units_kept": 2, "leftovers": 0, "same": True},
        {"left_kb": 96, "failed_at": "episodes.parquet", "units_kept": 8, "leftovers": 0, "same": False},
    ],
    "laws": [
        {"law": "never returns, compiled", "engine": "ideal-rk4", "outcomes": {"hung": 3, "settled": 1}, "broken": 3}
        | {"others_same": False}
    ],
}


def cells(table):
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()[2:]]


@pytest.fixture(scope="module")
def committed():
    found = survival.study(Run(RESULTS))
    if not found["kills"]:
        pytest.skip("results/survival/survival.json is not there: make kill-study")
    return found


def test_study_has_all_its_kills_and_each_run_ended_the_same(committed):
    kills = committed["kills"]
    assert len(kills) == KILLS
    for what, share in SHARES.items():
        assert sum(one["killed"] == what for one in kills) == round(share * KILLS)
    assert all(one["went_on"] and one["same"] for one in kills)


def test_study_killed_runs_in_their_middle(committed):
    done = [survival.files_done(one, committed["units"]) for one in committed["kills"]]
    assert sum(0 < k < committed["units"] for k in done) > KILLS / 4


def test_killed_run_left_no_process(committed):
    left = [one["left_s"] for one in committed["kills"] if one["killed"] == "local:2"]
    assert max(left) < 10.0


def test_full_disks_and_broken_laws_of_the_study_cost_nothing_else(committed):
    assert [one["left_kb"] for one in committed["disks"]] == list(LEFT_KB)
    assert all(one["same"] and not one["leftovers"] for one in committed["disks"])
    assert [one["law"] for one in committed["laws"]] == list(LAWS)
    assert all(one["others_same"] and one["broken"] for one in committed["laws"])


def test_kills_are_counted_by_how_far_the_run_had_come():
    rows = cells(survival.KILLS(survival.kills(MADE)))
    assert [row[2:] for row in rows] == [
        ["4", "1", "1", "2", "4", "3"],
        ["1", "0", "0", "1", "1", "1"],
        ["1", "0", "1", "0", "1", "1"],
        ["1", "0", "1", "0", "1", "1"],
    ]
    assert "Of 7 runs killed at random moments 6 ended" in survival.lead(MADE)
    assert "within 0.2 s" in survival.about(MADE)


def test_disks_and_laws_that_spoiled_something_say_so():
    disks = survival.disks(MADE["disks"], MADE["units"])
    assert "With 12 to 96 kB left, 2 to 8 of 8 units were kept, and 0 temporary files stayed" in disks
    assert "1 of 2 runs ended with the files of the undisturbed one" in disks
    laws = survival.laws(MADE["laws"])
    assert "the law never returns. Their own episodes: 3 hung, 1 settled. Beside 0 of the 1 all other" in laws


def test_page_without_a_study_has_nothing_to_say(tmp_path):
    parts = [part(Run(tmp_path, studies=tmp_path)) for part in (survival.facts, survival.tables)]
    assert not any(value for part in parts for value in part.values())
