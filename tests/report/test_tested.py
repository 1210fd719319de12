"""The table of long tests: its numbers are those of the studies' files, and a study that is absent has no row."""

import json

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make report)")

from bench.experiments.tables.schema import RESULTS
from report.figures.kit.page import Run
from report.figures.method import provenance

KILLS = [
    {"phase": phase, "same": same, "went_on": True, "units_done": done}
    for phase, same, done in (("merge", True, 8), ("parts", False, 2), ("parts", True, 5))
]


def test_committed_studies_lost_nothing():
    rows = list(provenance.describe_studies(Run(RESULTS)))
    assert len(rows) == 2
    kills = [row for row in provenance.count_kills(Run(RESULTS)) if "of two" not in row[0] and "local" not in row[0]]
    assert len(kills) == 8
    assert min(row[1] for row in kills) >= 10
    assert sum(row[1] for row in kills) == 100
    assert all(row[1] == row[3] == row[4] for row in provenance.count_kills(Run(RESULTS)))
    assert rows[0][2].endswith(" ended with the files of an undisturbed command")
    assert rows[1][2].endswith(", 0 by more than the gate allows")


def test_only_studies_that_are_there_have_a_row_and_a_kill_that_changed_the_files_shows(tmp_path):
    (tmp_path / "survival").mkdir()
    (tmp_path / "survival" / "survival.json").write_text(json.dumps({"kills": KILLS}))
    [row] = provenance.describe_studies(Run(tmp_path, studies=tmp_path))
    assert row[0].startswith("3 commands killed in 2 phases")
    assert row[2].startswith("2 ended with the files")
    counted = list(provenance.count_kills(Run(tmp_path, studies=tmp_path)))
    assert counted == [("merge", 1, "8 to 8", 1, 1), ("parts", 2, "2 to 5", 2, 1)]
