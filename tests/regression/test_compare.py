"""The regression gate finds each kind of change, and nothing where nothing changed."""

import shutil

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from support.tables import changed

from bench.cli import main
from bench.contenders.registry import find_contender
from bench.experiments import boundaries, traces
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.experiments.experiment import Settings
from bench.regression.rows import compare
from bench.running import run as running
from bench.tables.store import read, write_table


def ran(plan, tmp_path_factory):
    """The folder of a run."""
    folder = tmp_path_factory.mktemp("gate") / "reference"
    running.run(plan, folder, workers=1)
    return folder


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    laws = [find_contender("rotation-matrix"), find_contender("feedback-linearized/zyx-euler")]
    plan = planning.make("quick", laws, Choice(start_sets=("paper", "poles"), engines=("ideal-held",)), horizon_s=2.0)
    return ran(plan, tmp_path_factory)


@pytest.fixture
def candidate(reference, tmp_path):
    return shutil.copytree(reference, tmp_path / "candidate")


def change(folder, table, edit):
    frame = read(folder, table)
    write_table(folder / f"{table}.parquet", edit(frame), table)


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
    assert "traces: curve is missing: free-body rotation-matrix ideal-rk4 uniform uniform-00001" in compare(
        before, candidate
    )


def test_gate_ignores_what_a_failed_episode_measured(reference, candidate):
    def shake(frame):
        failed = frame["outcome"] != "settled"
        assert failed.any()
        return changed(frame, failed, effort=lambda effort: 3.0 * effort)

    change(candidate, "episodes", shake)
    assert compare(reference, candidate) == []


# ----------------------------------------------------------------------------------------------- arms


@pytest.fixture(scope="module")
def arm_reference(tmp_path_factory):
    """Two arms and two inverses: what only columns of an arm tell apart."""
    places, ways = (("arm-regulation",), ("clear",), ("native",), ("puma560", "ur5e")), ("solve", "truncated-svd")
    choice = Choice(*places, ("geometric",), ways, ("nominal", "mass-1.15"))
    plan = planning.make("quick", [find_contender("rotation-matrix")], choice, count=1, horizon_s=1.5)
    return ran(plan, tmp_path_factory)


@pytest.fixture
def arm_candidate(arm_reference, tmp_path):
    return shutil.copytree(arm_reference, tmp_path / "candidate")


def doubtful(folder, beside="", by=float("nan")):
    """Episodes that 1e-12 rad gives this other outcome, and changes by so much, as the run would have written them."""

    def edit(frame):
        frame["outcome_beside"], frame["rounding_change"] = beside, by
        return frame

    change(folder, "episodes", edit)


def nominal(frame):
    settled = (frame["variation"] == "nominal") & (frame["outcome"] == "settled")
    assert settled.any()
    return settled


def test_gate_tells_arms_variations_and_joints_apart(arm_reference, arm_candidate):
    assert len(read(arm_reference, "episodes")) == 8
    assert compare(arm_reference, arm_candidate) == []
    change(arm_candidate, "episodes", lambda frame: frame[(frame["arm"] == "ur5e") | (frame["variation"] == "nominal")])
    lines = compare(arm_reference, arm_candidate)
    assert len(lines) == 2
    assert all(
        line.startswith("episodes: row is missing: quick arm-regulation puma560 mass-1.15 rotation-matrix geometric ")
        for line in lines
    )


def test_gate_names_the_joints_that_a_cost_is_for(arm_reference, arm_candidate):
    def add_one(frame):
        rows = (frame["joints"] == 6) & (frame["inverse"] == "solve") & (frame["stage"] == "invert")
        frame.loc[rows & (frame["branch"] == "worst"), "div"] += 1
        return frame

    change(arm_candidate, "costs", add_one)
    assert any(
        line.endswith(": rotation-matrix geometric solve 6 joints worst invert")
        for line in compare(arm_reference, arm_candidate)
    )


@pytest.mark.parametrize(
    ("by_rounding", "change_by", "is_told"),
    [
        (float("nan"), 2e-6, True),
        (float("nan"), 5e-7, False),
        (1e-9, 2e-6, True),
        (1e-5, 5e-5, False),  # ten times what 1e-12 rad did
        (1e-5, 2e-4, True),
        (0.2, 5.0, False),
        (float("inf"), 5.0, False),
    ],
)
def test_gate_allows_a_torque_what_rounding_makes_of_it(
    arm_reference, arm_candidate, tmp_path, by_rounding, change_by, is_told
):
    before = shutil.copytree(arm_candidate, tmp_path / "before")

    def shake(frame):
        frame.loc[nominal(frame), "peak_tau_nm"] *= 1.0 + change_by
        return frame

    for folder in (before, arm_candidate):
        doubtful(folder, by=by_rounding)
    change(arm_candidate, "episodes", shake)
    lines = compare(before, arm_candidate)
    assert bool(lines) == is_told
    assert all(line.startswith("peak_tau_nm: ") for line in lines)


@pytest.mark.parametrize(
    ("beside", "beside_now", "is_told"),
    [("", "", True), ("diverged", "", False), ("", "settled", False), ("", "stuck", True), ("stuck", "stuck", False)],
)
def test_gate_asks_for_one_outcome_in_common(arm_candidate, tmp_path, beside, beside_now, is_told):
    before = shutil.copytree(arm_candidate, tmp_path / "before")
    doubtful(before, beside)
    doubtful(arm_candidate, beside_now)

    def flip(frame):
        frame["outcome"] = frame["outcome"].astype(str).where(~nominal(frame), "diverged")
        return frame

    change(arm_candidate, "episodes", flip)
    assert any(line.startswith("outcome: settled -> diverged") for line in compare(before, arm_candidate)) == is_told


def test_gate_compares_no_cause(arm_candidate, tmp_path):
    """It follows from two numbers of a failed episode, which are not compared either."""

    def fail(cause):
        def edit(frame):
            frame["outcome"], frame["cause"] = "diverged", cause
            return frame

        return edit

    before = shutil.copytree(arm_candidate, tmp_path / "before")
    change(before, "episodes", fail("representation"))
    change(arm_candidate, "episodes", fail("both"))
    assert compare(before, arm_candidate) == []


# ----------------------------------------------------------------------------------------- in contact


@pytest.fixture(scope="module")
def contact_reference(tmp_path_factory):
    """Two controllers on all poses of wrench-probe on one arm; the pole is among them."""
    controllers = ("hybrid-base+inverse", "impedance-coordinates/zyx-euler")
    choice = Choice(("wrench-probe",), arms=("ur5e",), controllers=controllers)
    plan = planning.make("quick", [], choice, horizon_s=0.02)
    return ran(plan, tmp_path_factory)


@pytest.fixture
def contact_candidate(contact_reference, tmp_path):
    return shutil.copytree(contact_reference, tmp_path / "candidate")


def in_compliance(folder, column, value, rows=lambda frame: frame["pose"] == "alpha+0 beta+45 gamma+0, about x"):
    """Give some rows of compliance.parquet another value there, or a function of the one they have."""

    def edit(frame):
        chosen = rows(frame) & (frame["controller"] == "impedance-coordinates")
        assert chosen.sum() == 1
        plain = frame[column].astype(str) if frame[column].dtype == "category" else frame[column]
        new = plain.map(value) if callable(value) else value
        frame[column] = plain.where(~chosen, new)
        return frame

    change(folder, "compliance", edit)


def on_the_pole(frame):
    return frame["pose"] == "alpha+0 beta+90 gamma+0, about x"


def test_gate_passes_in_contact_when_nothing_changed(contact_reference, contact_candidate):
    assert compare(contact_reference, contact_candidate) == []


def test_gate_catches_an_outcome_in_contact_and_names_its_row(contact_reference, contact_candidate):
    in_compliance(contact_candidate, "outcome", "broken")
    assert compare(contact_reference, contact_candidate) == [
        "outcome: done -> broken: quick wrench-probe ur5e impedance-coordinates zyx-euler "
        "alpha+0 beta+45 gamma+0, about x"
    ]


@pytest.mark.parametrize(
    ("column", "by"),
    [("c_xz", 1e-2), ("misalignment_rad", -2e-4), ("m_o", 1e-3), ("trials", 1), ("c_zz", float("nan"))],
)
def test_gate_catches_a_number_in_contact_that_changed_or_is_gone(contact_reference, contact_candidate, column, by):
    in_compliance(contact_candidate, column, lambda x: x + by if column == "trials" else x * (1.0 + by))
    [line] = compare(contact_reference, contact_candidate)
    assert line.startswith(f"{column}: ")


def test_gate_catches_a_hand_that_no_longer_comes_to_rest(contact_reference, contact_candidate):
    in_compliance(contact_candidate, "rest", "creeping")
    [line] = compare(contact_reference, contact_candidate)
    assert line.startswith("rest:  -> creeping: ")


@pytest.mark.parametrize(
    ("column", "was", "now", "lines"),
    [
        ("remaining_speed_m_per_s", 1e-6, 9e-6, 0),  # at rest, both
        ("remaining_speed_m_per_s", 1e-3, 1.2e-3, 1),
        ("time_to_rest_s", 3.4, 3.6, 0),
        ("time_to_rest_s", 3.4, 3.7, 1),
    ],
)
def test_gate_compares_how_a_hand_ends_as_far_as_a_last_slip_leaves_it(
    contact_candidate, tmp_path, column, was, now, lines
):
    before = shutil.copytree(contact_candidate, tmp_path / "before")
    for folder, value in ((before, was), (contact_candidate, now)):
        in_compliance(folder, column, value)
    assert len(compare(before, contact_candidate)) == lines


def test_gate_catches_a_pose_that_is_gone(contact_reference, contact_candidate):
    change(contact_candidate, "compliance", lambda frame: frame[frame["complies"] != "about z"])
    lines = compare(contact_reference, contact_candidate)
    assert lines[0].startswith("compliance: row is missing: quick wrench-probe ur5e hybrid-base inverse alpha+0")
    assert all("about z" in line for line in lines[:-1])


@pytest.mark.parametrize(
    ("rows", "torques", "lines"),
    [
        (on_the_pole, (0.5, 0.5), 0),  # rounding decides whether a coordinate is lost there
        (on_the_pole, (9.0, 9.0), 0),
        (lambda frame: frame["pose"] == "alpha+0 beta+89 gamma+0, about x", (0.5, 0.5), 1),
        (lambda frame: frame["pose"] == "alpha+0 beta+89 gamma+0, about x", (9.0, 0.5), 1),
        (lambda frame: frame["pose"] == "alpha+0 beta+89 gamma+0, about x", (9.0, 8.0), 0),
    ],
)
def test_gate_leaves_open_in_contact_what_rounding_decides(contact_candidate, tmp_path, rows, torques, lines):
    before = shutil.copytree(contact_candidate, tmp_path / "before")
    for folder, torque in zip((before, contact_candidate), torques, strict=True):
        in_compliance(folder, "peak_torque_ratio", torque, rows)
    in_compliance(before, "outcome", "done", rows)
    in_compliance(contact_candidate, "outcome", "saturated", rows)
    assert len(compare(before, contact_candidate)) == lines


def test_gate_says_that_a_reference_is_older_than_contact(contact_reference, contact_candidate, capsys):
    (contact_candidate / "compliance.parquet").unlink()
    assert main(["compare", str(contact_candidate), str(contact_reference)]) == 2
    assert "nothing to compare: " in (said := capsys.readouterr().err)
    assert "compliance.parquet: there is no such file" in said


def test_gate_refuses_a_folder_without_a_run(reference, tmp_path, capsys):
    assert main(["compare", str(reference), str(tmp_path)]) == 2
    assert "has not finished" in capsys.readouterr().err
