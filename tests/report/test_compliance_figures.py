"""Figures, tables and findings of the pages on compliance, from a few rows of every task in contact, and from none."""

import re

import numpy as np
import pandas as pd
import pytest
from support.pages import assert_is_whole, pasted

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

import tasks
from bench.engines.contact_episode import USUAL
from bench.experiments.contact import poses as contact_rows
from bench.experiments.contact import poses_of
from bench.experiments.tables import read
from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.side_by_side import predicted
from bench.law.control.registry import find_controller
from report.figures.contact import compliance, hand_axes, in_contact
from report.figures.contact import rows as controllers
from report.figures.contact.in_contact import MEASURES
from report.figures.contact.rows import CARTESIAN, EULER, PAPERS, PAPERS_EULER, ZYZ, level, of
from report.figures.kit.page import ABSENT, Run

ARM = "puma560"
HYBRIDS = (CARTESIAN, EULER, PAPERS, PAPERS_EULER)
WANTED = {compliance.PROBE: (*HYBRIDS, ZYZ), **dict.fromkeys(MEASURES, (*HYBRIDS, in_contact.SPRINGS))}
PROBED = re.compile(r"alpha\+0 beta\+(0|5|30|60|85) gamma\+0, about x( and y)?|alpha\+35 .*, about x and y")
SCENES = {
    "wrench-probe": PROBED,
    "surface-alignment": re.compile(r"tilt 20 about 0, .*"),  # that of the loop on the page
}


class Rows(Run):
    """A run whose rows about compliance are given; what else it holds is the reference's."""

    def __init__(self, frame):
        super().__init__(RESULTS / "reference")
        self.frame = frame

    def any_rows(self, table, **words):
        return read.chosen(self.frame, words)


def chosen(task: str, poses):
    """The poses that SCENES names; of other tasks one scene with every frame of the hand."""
    if task in SCENES:
        return tuple(pose for pose in poses if SCENES[task].fullmatch(pose[0].pose))
    scene = poses[0][0].scene_pos, poses[0][0].scene_wxyz
    return tuple(pose for pose in poses if (pose[0].scene_pos, pose[0].scene_wxyz) == scene)


@pytest.fixture(scope="module")
def run():
    """Rows of one arm, as a page reads them."""
    frames, arm = [], tasks.arm(ARM)
    for name, words in WANTED.items():
        task = tasks.contact_task(name)
        for controller in map(find_controller, words):
            poses = chosen(name, poses_of(controller, task, arm, dense=False))
            frames.append(contact_rows.frame("mine", controller, task, arm, poses, USUAL))
    return Rows(read.with_controller(pd.concat(frames, ignore_index=True)))


@pytest.fixture(scope="module")
def probe(run):
    return controllers.of_task(run, compliance.PROBE)


@pytest.mark.parametrize("page", [compliance, in_contact], ids=["compliance", "in-contact"])
def test_page_is_whole_and_says_so_when_a_run_holds_no_contact(page, run, tmp_path):
    assert_is_whole(page, run)
    nothing = pasted(page, Run(tmp_path))
    assert all(ABSENT in nothing[key] for key in ("off", "stuck", "outcomes") if key in nothing)


@pytest.mark.parametrize("beta", [30, 60])
def test_hand_is_drawn_turning_as_the_closed_form_of_the_papers_force_control_has_it(beta, probe):
    """About the axis, and as far, to the percent that the hand's own way costs where it turns by ten milliradians."""
    own = of(level(probe), PAPERS_EULER, hand_axes.ORDER)
    [C] = predicted(own[own["beta_deg"] == beta], "zyx-euler")
    full = float(of(level(probe), PAPERS, hand_axes.ORDER)["c_xx"].median())
    for one in hand_axes.turns(probe):
        if one["beta"] == beta and one["contender"] == PAPERS_EULER:
            k = "xyz".index(one["pushed"])
            across = np.linalg.norm(np.delete(C[:, k], k))
            assert one["off"] == pytest.approx(np.degrees(np.arctan2(across, abs(C[k, k]))), abs=1.0)
            assert one["share"] == pytest.approx(np.linalg.norm(C[:, k]) / full, rel=0.02)


def test_euler_hand_turns_the_further_off_the_more_it_leans(probe):
    by_beta = {one["beta"]: one for one in hand_axes.turns(probe) if is_euler(one) and one["pushed"] == "x"}
    assert by_beta[85.0]["off"] > 80.0
    assert list(by_beta) == sorted(by_beta, key=lambda beta: by_beta[beta]["off"])


def is_euler(one) -> bool:
    return one["contender"] == PAPERS_EULER


def test_map_holds_beta_where_the_frame_is_level_and_a_cross_where_nothing_is_left(probe):
    by = {name: level(of(probe, name)) for name in (EULER, ZYZ)}
    values, words = compliance.cells(by[EULER])
    assert values.loc["about x and y"].to_numpy() == pytest.approx(values.columns.to_numpy(), abs=0.1)
    assert words.loc["about x", 60.0] == "60"
    failed = by[ZYZ].assign(outcome="singular")
    assert set(compliance.cells(failed)[1].to_numpy().ravel()) == {compliance.FAILED}


def test_loop_shows_a_tool_that_lies_flat_and_one_that_does_not(run):
    said = in_contact.plate(controllers.of_task(run, "surface-alignment"))
    assert float(said["plate_cartesian"]) < 0.1
    assert float(said["plate_euler"]) > 10.0


def test_every_task_in_contact_is_shown():
    free = {"wrench-probe", "compliance-loop"}
    assert set(MEASURES) == set(tasks.contact_names()) - free
