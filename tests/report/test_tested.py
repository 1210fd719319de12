"""The table of long tests: its numbers are those of the studies' files, and a study that is absent has no row."""

import json

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make report)")

from bench.experiments.tables.schema import RESULTS
from report.figures.kit.page import Run
from report.figures.method import tested

MACHINE = {"cpu": "A|B", "cores": 2}
KILLS = {
    "provenance": MACHINE,
    "units": 8,
    "kills": [{"same": True, "left_s": None}, {"same": False, "left_s": 0.25}, {"same": True, "left_s": 0.1}],
}


def make_run(scheduler, episodes, each_us, wall_s, rows="digest"):
    sizes = {"episodes": episodes, "cpu_s": 1e-6 * each_us * episodes, "peak_bytes": 4e8 + episodes}
    return {"scheduler": scheduler, **sizes, "wall_s": wall_s, "rows": rows}


def test_committed_studies_lost_nothing():
    run = Run(RESULTS)
    assert len(tested.tables(run)["studies"].splitlines()) == 2 + 4
    kills = json.loads((run.studies / "survival" / "survival.json").read_text())["kills"]
    assert len(kills) == 100
    assert all(one["same"] and one["went_on"] for one in kills)
    settings = json.loads((run.studies / "settings" / "settings.json").read_text())
    assert all(one["gate"] == 0 for machine in settings.values() for one in machine.values())


def test_kills_are_counted_and_one_that_changed_the_files_shows(tmp_path):
    (tmp_path / "survival").mkdir()
    (tmp_path / "survival" / "survival.json").write_text(json.dumps(KILLS))
    table = tested.tables(Run(tmp_path, studies=tmp_path))["studies"]
    assert "3 runs of 8 units killed" in table
    assert "2 ended with the files of an undisturbed run; workers of a killed run end within 0.2 s" in table


def test_cost_is_the_median_over_runs_and_efficiency_one_threads_time():
    sizes = [make_run("threads", n, us, 1.0) for n, us in ((10**4, 200), (10**4, 220), (10**4, 300), (10**6, 230))]
    by = [make_run("threads", 10**5, 200, 20.0), make_run("local:2", 10**5, 200, 12.5, "other")]
    found = {"sizes": sizes, "schedulers": by, "provenance": {"sizes": MACHINE, "schedulers": MACHINE}}
    cost, processes = (row[2] for row in tested.describe_scale(found))
    assert cost.startswith("230 µs of CPU an episode instead of 220 (200 to 300 over runs); at most 401 MB")
    assert processes == "**other rows**; one thread's time is 80 % of the time of both processes"


def test_nothing_is_shown_of_studies_that_are_absent(tmp_path):
    assert tested.tables(Run(tmp_path, studies=tmp_path)) == {"studies": None}
