"""The row gate finds each kind of change in a run, and nothing that rounding alone can make."""

import shutil

import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from support.tables import changed

from bench.base.files import read_json, write_json
from bench.cli import main
from bench.experiments import boundaries, traces
from bench.experiments import plan as planning
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.request import Request
from bench.experiments.tables.store import read, write_table
from bench.law.contenders.registry import find_contender
from bench.regression.rows import compare
from bench.running.run import run

NAN, INF = float("nan"), float("inf")


def ran(plan, tmp_path_factory):
    """Run a plan and return its folder."""
    folder = tmp_path_factory.mktemp("gate") / "reference"
    run(plan, folder, workers=1)
    return folder


def change(folder, table, edit):
    """Put edit(frame) in the place of a table."""
    write_table(folder / f"{table}.parquet", edit(read(folder, table)), table)


@pytest.fixture(scope="module")
def body(tmp_path_factory):
    """Two laws on the free body."""
    laws = (find_contender("rotation-matrix"), find_contender("feedback-linearized/zyx-euler"))
    plan = planning.make(
        Request("quick", laws, start_sets=("paper", "poles"), engines=("ideal-held",), horizon_s=2.0)
    )
    return ran(plan, tmp_path_factory)


@pytest.fixture(scope="module")
def arms(tmp_path_factory):
    """Two arms and two inverses, which only the columns of an arm distinguish."""
    request = Request(
        "quick",
        (find_contender("rotation-matrix"),),
        count=1,
        horizon_s=1.5,
        tasks=("arm-regulation",),
        start_sets=("clear",),
        engines=("native",),
        arms=("puma560", "ur5e"),
        jacobians=("geometric",),
        inverses=("solve", "truncated-svd"),
        variations=("nominal", "mass-1.15"),
    )
    return ran(planning.make(request), tmp_path_factory)


@pytest.fixture(scope="module")
def contact(tmp_path_factory):
    """One controller on all poses of wrench-probe on one arm; the pole is among them."""
    request = Request(
        "quick",
        horizon_s=0.02,
        tasks=("wrench-probe",),
        arms=("ur5e",),
        controllers=("impedance-coordinates/zyx-euler",),
    )
    return ran(planning.make(request), tmp_path_factory)


@pytest.fixture
def pair(request, tmp_path):
    """pair(run): two copies of a run."""

    def copy(run):
        finished = request.getfixturevalue(run)
        return [shutil.copytree(finished, tmp_path / name) for name in ("base", "head")]

    return copy


def settled(frame):
    return frame.index[frame["outcome"] == "settled"][3:4]


def failed(frame):
    assert (frame["outcome"] != "settled").any()
    return frame["outcome"] != "settled"


def worst_total(frame):
    return (frame["regulator"] == "rotation-matrix") & (frame["branch"] == "worst") & (frame["stage"] == "total")


@pytest.mark.parametrize(
    ("table", "edit", "says"),
    [
        ("episodes", lambda frame: changed(frame, settled(frame), outcome="stuck"), "outcome: settled -> stuck"),
        (
            "costs",
            lambda frame: changed(frame, worst_total(frame), mul=lambda mul: mul + 1),
            "mul: 25 -> 26: rotation-matrix worst total",
        ),
        ("episodes", lambda frame: changed(frame, settled(frame), settling_time_s=0.1 + 0.2), "settling_time_s: "),
        ("episodes", lambda frame: frame.drop(index=5), "episodes: row is missing: quick free-body"),
        ("episodes", lambda frame: changed(frame, failed(frame), effort=lambda effort: 3.0 * effort), ""),
    ],
    ids=["one flipped outcome", "one more multiplication", "another time", "a missing row", "effort of a failure"],
)
def test_gate_catches_a_change_on_the_body(pair, table, edit, says):
    base, head = pair("body")
    change(head, table, edit)
    lines = compare(base, head)
    assert [line[: len(says)] for line in lines] == [says] * bool(says)
    assert "0000" not in "".join(lines)  # 0.1 + 0.2 is shown as 0.3
    assert main(["compare", str(base), str(head)]) == bool(says)


@pytest.mark.parametrize("edit", ["unit", "name", "type"])
def test_gate_catches_a_changed_column(pair, edit):
    base, head = pair("body")
    table = pq.read_table(head / "episodes.parquet")
    place = table.schema.get_field_index("effort")
    field = table.schema.field(place)
    other = {"unit": field.with_metadata({"unit": "N m"}), "name": field.with_name("work")}
    new = other.get(edit) or field.with_type(pa.float32())
    schema = table.schema.set(place, new)
    column = table.column(place).cast(new.type, safe=False)
    pq.write_table(
        table.set_column(place, new, column).replace_schema_metadata(schema.metadata), head / "episodes.parquet"
    )
    assert any("column effort" in line for line in compare(base, head))


def test_gate_catches_a_moved_boundary_and_a_curve_that_bends_or_is_gone(pair, tmp_path):
    base, head = pair("body")
    for folder in (base, head):
        unit = boundaries.of_law(find_contender("linearized-euler"), 16)
        write_table(folder / "boundaries.parquet", rows_of(Request(), unit), "boundaries")
        unit = traces.of_law(find_contender("rotation-matrix"), 3)
        write_table(folder / "traces.parquet", rows_of(Request(), unit), "traces")
    assert compare(base, head) == []

    def move(frame):
        row = frame.index[frame["fails_from_rad"].notna()][0]
        return changed(frame, row, fails_from_rad=lambda angle: angle + 1e-3)

    change(head, "boundaries", move)
    change(head, "traces", lambda frame: changed(frame, 7, omega_x=lambda rate: rate + 1e-3))
    assert sorted(line.partition(":")[0] for line in compare(base, head)) == ["fails_from_rad", "omega_x"]
    change(head, "traces", lambda frame: frame[frame["start_id"] != "uniform-00001"])
    assert any(line.startswith("traces: row is missing: free-body") for line in compare(base, head))


def nominal(frame):
    return (frame["variation"] == "nominal") & (frame["outcome"] == "settled")


@pytest.mark.parametrize(
    ("by_rounding", "change_by", "is_said"),
    [
        (NAN, 2e-6, True),
        (NAN, 5e-7, False),
        (1e-9, 2e-6, True),
        (1e-5, 5e-5, False),  # ten times what 1e-12 rad did
        (1e-5, 2e-4, True),
        (INF, 5.0, False),
    ],
)
def test_gate_allows_a_torque_what_rounding_makes_of_it(pair, by_rounding, change_by, is_said):
    folders = pair("arms")
    for folder in folders:
        change(folder, "episodes", lambda frame: frame.assign(rounding_change=by_rounding))
    change(
        folders[1], "episodes", lambda frame: changed(frame, nominal(frame), peak_tau_nm=lambda x: x * (1 + change_by))
    )
    lines = compare(*folders)
    assert bool(lines) == is_said
    assert all(line.startswith("peak_tau_nm: ") for line in lines)


@pytest.mark.parametrize(
    ("beside", "beside_now", "is_said"),
    [("", "", True), ("diverged", "", False), ("", "settled", False), ("", "stuck", True), ("stuck", "stuck", False)],
)
def test_gate_wants_one_outcome_in_common_and_no_cause(pair, beside, beside_now, is_said):
    base, head = pair("arms")
    change(base, "episodes", lambda frame: frame.assign(outcome_beside=beside))
    change(head, "episodes", lambda frame: frame.assign(outcome_beside=beside_now, cause="both"))
    change(head, "episodes", lambda frame: changed(frame, nominal(frame), outcome="diverged"))
    lines = compare(base, head)
    assert bool(lines) == is_said
    assert all(line.startswith("outcome: settled -> diverged: quick arm-regulation ") for line in lines)


FREE, POLE, NEAR = (f"alpha+0 beta+{beta} gamma+0, about x" for beta in (45, 90, 89))
PEG = {"task": "peg-in-hole"}


@pytest.mark.parametrize(
    ("pose", "before", "after", "says"),
    [
        (FREE, {}, {"outcome": "broken"}, "outcome: done -> broken: quick wrench-probe ur5e impedance-coordinates"),
        (FREE, {}, {"c_xz": lambda x: x * 1.01}, "c_xz: "),
        (FREE, {}, {"misalignment_rad": lambda x: x * 0.9998}, "misalignment_rad: "),
        (FREE, {}, {"trials": lambda x: x + 1}, "trials: "),
        (FREE, {}, {"c_zz": NAN}, "c_zz: "),
        (FREE, {}, {"rest": "creeping"}, "rest:  -> creeping: "),
        (FREE, {"remaining_speed_m_per_s": 1e-6}, {"remaining_speed_m_per_s": 9e-6}, ""),  # at rest, both
        (FREE, {"remaining_speed_m_per_s": 1e-3}, {"remaining_speed_m_per_s": 1.2e-3}, "remaining_speed_m_per_s: "),
        (FREE, {"time_to_rest_s": 3.4}, {"time_to_rest_s": 3.6}, ""),
        (FREE, {"time_to_rest_s": 3.4}, {"time_to_rest_s": 3.7}, "time_to_rest_s: "),
        # rounding decides where the last slip of a peg ends, and of no other hand
        (FREE, PEG | {"force_error_end_n": 0.042}, PEG | {"force_error_end_n": 0.038}, ""),
        (FREE, PEG | {"force_error_end_n": 0.042}, PEG | {"force_error_end_n": 0.056}, "force_error_end_n: "),
        (FREE, {"force_error_end_n": 0.042}, {"force_error_end_n": 0.038}, "force_error_end_n: "),
        # rounding decides whether a coordinate is lost on the pole, and what a hand does that was thrown about
        (POLE, {"peak_torque_ratio": 0.5, "outcome": "done"}, {"peak_torque_ratio": 0.5, "outcome": "saturated"}, ""),
        (NEAR, {"peak_torque_ratio": 9.0, "outcome": "done"}, {"peak_torque_ratio": 8.0, "outcome": "saturated"}, ""),
        (NEAR, {"peak_torque_ratio": 9.0, "outcome": "done"}, {"peak_torque_ratio": 0.5, "outcome": "slow"}, "outcome"),
    ],
)
def test_gate_catches_in_contact_what_no_rounding_decides(pair, pose, before, after, says):
    folders = pair("contact")
    for folder, cells in zip(folders, (before, after), strict=True):
        change(folder, "compliance", lambda frame, cells=cells: changed(frame, frame["pose"] == pose, **cells))
    assert [line[: len(says)] for line in compare(*folders)] == [says] * bool(says)


@pytest.mark.parametrize("judge", ["the same", "another"])
@pytest.mark.parametrize(
    ("table", "words", "count"),
    [
        ("episodes", {"regulator": "a-new-law"}, 0),
        ("robustness", {"axis": "a-new-axis"}, 0),
        ("episodes", {"arm": "a-new-arm"}, 0),
        ("episodes", {"start_id": ["new-1", "new-2", "new-3"]}, 3),
    ],
)
def test_rows_of_what_base_has_nowhere_are_no_difference_whatever_the_judge(pair, judge, table, words, count):
    base, head = pair("body")
    unit = Unit("robustness", "rotation-matrix", selector="delay", count=1, total=1, horizon_s=0.05)
    perturbed = rows_of(Request(), unit)
    for folder, name in ((base, "the same"), (head, judge)):
        write_table(folder / "robustness.parquet", perturbed, "robustness")
        write_json(folder / "provenance.json", read_json(folder / "provenance.json") | {"judge": name})
    change(head, table, lambda frame: pd.concat([frame, frame.head(3).assign(**words)]))
    lines = compare(base, head)
    assert lines[-1:] == ["episodes: rows new: 3"] if count and judge == "another" else len(lines) == count
    change(head, "episodes", lambda frame: changed(frame, settled(frame), outcome="stuck"))
    assert ["outcome" in line for line in compare(base, head)].count(True) == 1
