"""One file adds a task, a start set or an arm; they load by the words of dm_control.suite too."""

import os
import subprocess
import sys

import pytest

import tasks
from tasks import starts, suite
from tasks.base import StartSet
from tasks.discovery import constants


def test_start_set_types_are_named_as_their_files():
    for name, found in constants(starts, "STARTS").items():
        assert isinstance(found, StartSet)
        assert found.name == name
    assert all(tasks.start_set_title(name, arm=True) for name in tasks.start_set_names(arm=True))


def test_loading_writes_nothing_to_stderr():
    """Without a display, GLFW would warn as dm_control looks for a renderer that the judge never uses."""
    environ = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "MUJOCO_GL")}
    command = [sys.executable, "-c", "import tasks; tasks.load().reset()"]
    done = subprocess.run(command, env=environ, capture_output=True, text=True, check=True)
    assert done.stderr == ""


def test_every_task_loads_by_the_words_of_dm_control():
    listed = suite.list_tasks()
    assert {domain for domain, _ in listed} == {*tasks.names(), *tasks.contact_names()}
    for domain, task in listed:
        environment = suite.load(domain, task, environment_kwargs={"time_limit": 0.1, "control_timestep": 2e-3})
        assert environment.control_timestep() == 2e-3


def test_start_is_a_word_of_the_task():
    start = tasks.start_set("uniform", 4)[3]
    environment = suite.load("free-body", suite.NO_ARM, {"start": start})
    assert environment.reset().observation["goal_quat"] == pytest.approx(start.goal_wxyz)
