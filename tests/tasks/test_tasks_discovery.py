"""One file adds a task, a start set or an arm."""

import os
import subprocess
import sys

import tasks
from tasks import starts
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
