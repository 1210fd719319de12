"""The regression gate finds each kind of change, and nothing where nothing changed."""

import shutil

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from support.comparing import change, ran
from support.tables import changed

from bench.cli import main
from bench.contenders.registry import find_contender
from bench.experiments import boundaries, traces
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.experiments.experiment import Settings
from bench.regression.rows import compare
from bench.tables.store import write_table


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    laws = [find_contender("rotation-matrix"), find_contender("feedback-linearized/zyx-euler")]
    plan = planning.make("quick", laws, Choice(start_sets=("paper", "poles"), engines=("ideal-held",)), horizon_s=2.0)
    return ran(plan, tmp_path_factory)


@pytest.fixture
def candidate(reference, tmp_path):
    return shutil.copytree(reference, tmp_path / "candidate")


def test_gate_passes_when_nothing_changed(reference, candidate):
    assert compare(reference, candidate) == []
    assert main(["compare", str(reference), str(candidate)]) == 0


def worst_total(frame):
    return (frame["regulator"] == "rotation-matrix") & (frame["branch"] == "worst") & (frame["stage"] == "total")


def settled(frame):
    return frame.index[frame["outcome"] == "settled"][3:4]


@pytest.mark.parametrize(
    ("table", "edit", "says"),
    [
        ("episodes", lambda frame: changed(frame, settled(frame), outcome="stuck"), "outcome: settled -> stuck"),
        (
            "costs",
            lambda frame: changed(frame, worst_total(frame), mul=lambda mul: mul + 1),
            "mul: 25 -> 26: rotation-matrix worst total",
        ),
        (
            "episodes",
            lambda frame: changed(frame, settled(frame), settling_time_s=0.1 + 0.2),
            "settling_time_s: ",
        ),
        ("episodes", lambda frame: frame.drop(index=5), "episodes: row is missing: quick free-body"),
    ],
    ids=["one flipped outcome", "one more multiplication", "another time", "a missing row"],
)
def test_gate_catches(reference, candidate, capsys, table, edit, says):
    change(candidate, table, edit)
    [line] = compare(reference, candidate)
    assert line.startswith(says)
    assert "0000" not in line  # 0.1 + 0.2 is shown as 0.3
    assert main(["compare", str(reference), str(candidate)]) == 1
    assert says.partition(": ")[2].partition(":")[0] in capsys.readouterr().out


def test_gate_catches_a_new_row(reference, candidate):
    def paper(frame):
        return frame["start_id"] == "figure-2.3"

    change(candidate, "episodes", lambda frame: changed(frame, paper(frame), start_id="figure-9.9"))
    lines = compare(reference, candidate)
    assert any(line.startswith("episodes: row is new") for line in lines)
    assert any(line.startswith("episodes: row is missing") for line in lines)


@pytest.mark.parametrize("edit", ["unit", "name", "type"])
def test_gate_catches_a_changed_column(reference, candidate, edit):
    path = candidate / "episodes.parquet"
    table = pq.read_table(path)
    place = table.schema.get_field_index("effort")
    field = table.schema.field(place)
    changed = {
        "unit": field.with_metadata({"unit": "N m"}),
        "name": field.with_name("work"),
        "type": field.with_type(pa.float32()),
    }[edit]
    schema = table.schema.set(place, changed)
    column = table.column(place).cast(changed.type, safe=False)
    pq.write_table(table.set_column(place, changed, column).replace_schema_metadata(schema.metadata), path)
    lines = compare(reference, candidate)
    assert any("column effort" in line for line in lines)


def test_gate_catches_a_moved_failure_boundary(reference, candidate, tmp_path):
    unit = boundaries.of_law(find_contender("linearized-euler"), 16)
    write_table(candidate / "boundaries.parquet", boundaries.rows(Settings(), unit), "boundaries")
    before = shutil.copytree(candidate, tmp_path / "before")

    def move(frame):
        row = frame.index[frame["fails_from_rad"].notna()][0]
        return changed(frame, row, fails_from_rad=lambda angle: angle + 1e-3)

    assert compare(before, candidate) == []
    change(candidate, "boundaries", move)
    [line] = compare(before, candidate)
    assert line.startswith("fails_from_rad: ")


def test_gate_catches_a_curve_that_bends_and_one_that_is_gone(candidate, tmp_path):
    unit = traces.of_law(find_contender("rotation-matrix"), 3)
    write_table(candidate / "traces.parquet", traces.rows(Settings(), unit), "traces")
    before = shutil.copytree(candidate, tmp_path / "before")
    assert compare(before, candidate) == []

    change(candidate, "traces", lambda frame: changed(frame, 7, omega_x=lambda rate: rate + 1e-3))
    [line] = compare(before, candidate)
    assert line.startswith("omega_x: ")
    change(candidate, "traces", lambda frame: frame[frame["start_id"] != "uniform-00001"])
    assert all("row is missing" in line and "uniform-00001" in line for line in compare(before, candidate)[:-1])


def test_gate_ignores_what_a_failed_episode_measured(reference, candidate):
    def shake(frame):
        failed = frame["outcome"] != "settled"
        assert failed.any()
        return changed(frame, failed, effort=lambda effort: 3.0 * effort)

    change(candidate, "episodes", shake)
    assert compare(reference, candidate) == []


def test_gate_refuses_a_folder_without_a_run(reference, tmp_path, capsys):
    assert main(["compare", str(reference), str(tmp_path)]) == 2
    assert "has not finished" in capsys.readouterr().err
