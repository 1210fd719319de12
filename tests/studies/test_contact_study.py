"""The committed study of contact is what the code gives now, where a few of its rows are made anew."""

import math

import pytest

import tasks
from bench.control.setpoint import TOUCH
from bench.engines.run_contact import run
from bench.metrics.contact.scene import alignment_error
from bench.metrics.contact_metric import Pose, response
from bench.studies.contact import pegs, springs, stability
from bench.studies.contact.__main__ import PARTS, STORED
from bench.tables.files import read_json

FOUND = read_json(STORED)


def test_every_part_is_there():
    assert set(FOUND) == set(PARTS)
    assert all(FOUND.values())


@pytest.mark.parametrize("delay", [10, 20])
def test_boundary_is_where_it_was(delay):
    controller = "hybrid-base+inverse"
    [row] = [one for one in FOUND["boundary"] if (one["controller"], one["delay_ms"]) == (controller, delay)]
    assert stability.is_steady(stability.pressed(controller, TOUCH.kf, row["measured"] / 1.12, 1e-3 * delay))
    assert not stability.is_steady(stability.pressed(controller, TOUCH.kf, row["measured"] * 1.12, 1e-3 * delay))


@pytest.mark.parametrize("stiffness", [50.0, 2.0])
def test_springs_leave_what_they_left(stiffness):
    task, arm, one = tasks.contact_task("surface-alignment"), tasks.arm("ur5e"), springs.softened(stiffness)
    [row] = [
        each
        for each in FOUND["springs"]
        if (each["stiffness"], each["arm"], each["trial"]) == (stiffness, "ur5e", "tilt 20 about 0, beta+0")
    ]
    trial = next(each for each in task.trials(arm) if each.id == row["trial"])
    pose = Pose(task, arm, one, (response(trial, next(run("native", one, task, arm, [trial]))),))
    assert math.degrees(alignment_error(pose)) == pytest.approx(row["left_deg"], rel=1e-2)


def test_pegs_that_stick_at_rest_between_the_walls_are_jammed_by_their_load():
    stuck = [one for one in FOUND["fits"] if one.get("margin") and one["rested"]]
    assert len(stuck) >= 3
    assert all(one["margin"] > 1.0 for one in stuck)
    assert {one["clearance"] for one in FOUND["fits"]} == set(pegs.CLEARANCES)
