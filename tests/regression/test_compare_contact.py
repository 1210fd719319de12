"""The gate in contact: outcomes, numbers, how a hand ends, and what rounding may change."""

import shutil

import pytest
from support.comparing import change, ran

from bench.cli import main
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.regression.rows import compare


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
