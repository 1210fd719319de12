"""The committed study of contact keeps to theory, and is what the code gives now, where a few rows are made anew."""

import math

import pandas as pd
import pytest

import tasks
from bench.base.files import read_json
from bench.engines.metrics.contact.scene import alignment_error
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.simulate_contact import run_contact as run
from bench.experiments.impedance import STIFFNESSES
from bench.law.control.setpoint import TOUCH
from bench.studies.contact import admittance, pegs, springs, stability, unshaped
from bench.studies.contact.__main__ import PARTS, STORED

FOUND = {part: pd.DataFrame(rows) for part, rows in read_json(STORED).items()}
FOUND["admittance"] = FOUND["admittance"].dropna(subset="measured")
IN_TASKS = FOUND["unshaped-tasks"]
FOUND["unshaped-tasks"] = IN_TASKS.merge(
    IN_TASKS.query("damping == 'shaped'"), on=["task", "arm"], suffixes=("", "_shaped"), validate="many_to_one"
)


def one_of(part, rows):
    """Return the only row of a part of the study that an expression chooses."""
    [row] = FOUND[part].query(rows).to_dict("records")
    return row


def test_every_part_is_there():
    assert set(FOUND) == set(PARTS)
    assert all(map(len, FOUND.values()))
    assert set(FOUND["fits"]["clearance"]) == set(pegs.CLEARANCES)


UNSTABLE = "arm == 'panda' and damping == 'diagonal'"
"""In free motion already, at the larger stiffness."""


@pytest.mark.parametrize(
    ("part", "rows", "least", "holds"),
    [
        # pegs that stick at rest between the walls are jammed by their load
        ("fits", "margin > 0 and rested", 3, "margin > 1"),
        # limits of servos are the closed form to a thousandth; on the arm two bisections err by 1.4 % each
        ("admittance", "plant == 'servo'", 5, "abs(measured / theory - 1) <= 1e-3"),
        ("admittance", "plant == 'arm'", 8, "abs(measured / theory - 1) <= 0.03"),
        # an unshaped impedance settles on every plane but where it is unstable in free motion
        ("unshaped", "damping != ''", 30, f"settles != ({UNSTABLE} and stiffness == 2000)"),
        # it gives no more than it has stored, its account closes, and its force is that of two springs in series,
        # though what creeps at 150 N/m by the shipped rule has not quite arrived
        ("unshaped", "settles", 30, "0 <= given and given < stored and unaccounted < 0.02"),
        (
            *("unshaped", "settles", 30),
            f"abs(force * stiffness * (1 / stiffness + 1 / plane) / {unshaped.FORCE_N} - 1) <= 1e-2",
        ),
        # springs alone decide where a hand comes to rest; the difference is within dry friction
        ("unshaped-tasks", "damping != 'shaped' and outcome == 'done'", 20, "abs(done / done_shaped - 1) <= 2e-3"),
        ("unshaped-tasks", "damping != 'shaped' and outcome == 'done'", 20, "given < 2 * given_shaped"),
        ("unshaped-tasks", "damping != ''", 30, f"(outcome == 'done') != ({UNSTABLE})"),
    ],
)
def test_numbers_of_the_study_keep_to_theory(part, rows, least, holds):
    found = FOUND[part].query(rows, engine="python")
    assert len(found) >= least
    assert found[~found.eval(holds, engine="python")].to_dict("records") == []


@pytest.mark.parametrize("delay", [10, 20])
def test_boundary_is_where_it_was(delay):
    controller = "hybrid-base+inverse"
    row = one_of("boundary", f"controller == '{controller}' and delay_ms == {delay}")
    assert stability.is_steady(stability.pressed(controller, TOUCH.kf, row["measured"] / 1.12, 1e-3 * delay))
    assert not stability.is_steady(stability.pressed(controller, TOUCH.kf, row["measured"] * 1.12, 1e-3 * delay))


@pytest.mark.parametrize("stiffness", [50.0, 2.0])
def test_springs_leave_what_they_left(stiffness):
    task, arm, one = tasks.contact_task("surface-alignment"), tasks.arm("ur5e"), springs.softened(stiffness)
    row = one_of("springs", f"stiffness == {stiffness} and arm == 'ur5e' and trial == 'tilt 20 about 0, beta+0'")
    trial = next(each for each in task.trials(arm) if each.id == row["trial"])
    pose = Pose(task, arm, one, (response(trial, next(run("native", one, task, arm, [trial]))),))
    assert math.degrees(alignment_error(pose)) == pytest.approx(row["left_deg"], rel=1e-2)


ADMITTANCE = FOUND["admittance"].to_dict("records")


@pytest.mark.parametrize("row", ADMITTANCE[5:7] + ADMITTANCE[-1:], ids=lambda row: f"{row['plant']}-{row['delay_ms']}")
def test_limit_of_an_admittance_is_where_it_was(row):
    lag_s, delay = 1e-3 * row["lag_ms"], row["delay_ms"]
    for share, holds in ((0.97, True), (1.03, False)):
        K = share * row["measured"]
        if row["plant"] == "servo":
            assert admittance.is_damped(K, lag_s, delay) == holds
        else:
            assert admittance.calms(admittance.pressed(K, 2.0 / lag_s, delay)) == holds


def test_row_of_the_unshaped_impedance_is_where_it_was():
    row = one_of("unshaped", "arm == 'ur5e' and damping == 'per-axis' and stiffness == 2000 and plane == 1e6")
    made = unshaped.pressed("ur5e", "per-axis", STIFFNESSES[1], 1e6)
    assert made["force"] == pytest.approx(row["force"], rel=1e-3)
    assert made["given"] == pytest.approx(row["given"], rel=0.05)


def test_row_of_a_task_is_where_it_was():
    row = one_of("unshaped-tasks", "task == 'crank' and arm == 'ur5e' and damping == 'double-diagonalization'")
    made = unshaped.done("crank", "ur5e", "double-diagonalization")
    assert made["done"] == pytest.approx(row["done"], rel=1e-3)
    assert made["given"] == pytest.approx(row["given"], rel=1e-2)
