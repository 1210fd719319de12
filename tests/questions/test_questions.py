"""Questions from the field: a symptom shows, a cure cures, and a picture is a drawing of both."""

import json
import re

import numpy as np
import pytest
from support.command_line import bench

from bench.errors import UnknownWord
from bench.questions.picture import picture
from bench.questions.question import Curves, every_question, find, question

QUESTIONS = every_question()
each = pytest.mark.parametrize("one", QUESTIONS.values(), ids=lambda one: one.name)
ASKED = {
    *("drake-3451", "kdl-109", "lerobot-3691", "ur-driver-540", "control-libraries-332", "franka-ros-215"),
    *("control-toolbox-190", "tsid-118", "moveit-msgs-82", "ros2-controllers-1178", "lbr-fri-247", "rcs-141"),
}
"""The twelve that are never given up; others may come and go."""


def test_the_twelve_are_there():
    assert set(QUESTIONS) >= ASKED


@each
def test_symptom_shows_and_cure_cures(one):
    found = find(one)
    assert found.shows
    assert found.cures


@each
def test_curves_are_numbers_over_a_range_that_cause_and_cure_differ_on(one):
    curves = one.curves()
    assert len({len(values) for values in curves}) == 1
    assert all(np.isfinite(values).all() for values in curves)
    assert len(np.unique(curves.x)) == len(curves.x) >= 20
    assert np.abs(curves.before - curves.after).max() > one.tolerance


@each
def test_name_is_the_file_s_and_threads_are_addresses(one):
    assert QUESTIONS[one.name] is one
    assert all(re.fullmatch(r"[\w.-]+/[\w.-]+#\d+", thread) for thread in one.threads)
    assert all((one.title, one.asked, one.cause, one.cure, one.x, one.y))


def test_cure_that_does_not_cure_is_found_out():
    one = question("rcs-141")
    curves = one.curves()
    assert not find(one, Curves(curves.x, curves.before, curves.before)).cures
    assert not find(one, Curves(curves.x, curves.after, curves.after)).shows


def test_unknown_question_names_the_known_ones():
    with pytest.raises(UnknownWord, match=r"did you mean 'rcs-141'"):
        question("rcs-14")


def test_picture_draws_both_lines(tmp_path):
    pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")
    picture(question("rcs-141"), tmp_path / "new" / "one.svg")
    drawn = (tmp_path / "new" / "one.svg").read_text()
    lines = [path for path in re.findall(r'<path d="([^"]+)"', drawn) if path.count("L") > 50]
    assert len(lines) == 2
    assert len(set(lines)) == 2


def test_command_lists_all_and_says_one(capsys):
    assert re.findall(r"^(\S+)", bench(capsys, "question").out, re.MULTILINE) == list(QUESTIONS)
    said = bench(capsys, "question", "rcs-141")
    assert said.code == 0
    assert "25.3: direction lost [deg]" in said.out
    assert "github.com/RobotControlStack/robot-control-stack/issues/141" in said.out


def test_command_writes_json(capsys):
    said = json.loads(bench(capsys, "question", "rcs-141", "--json").out)
    assert said["shows"] is said["cures"] is True
    assert said["symptom"] == pytest.approx(25.3, abs=0.05)
