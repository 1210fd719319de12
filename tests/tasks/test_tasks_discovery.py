"""One file adds a task, a start set or an arm."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import tasks
from tasks import starts
from tasks.base import StartSet
from tasks.discovery import constants

TASK_FILE = """
from tasks.base import Task
from tasks.domains import free_body

TASK = free_body.TASK._replace(name="dropped-in", title="A file that was dropped in")
"""

STARTS_FILE = """
from tasks.base import Start, StartSet

def build(count, seed):
    return [Start("one", (1.0, 0.0, 0.0, 0.0))]

STARTS = StartSet("only-one", "A set of one", 1, build)
"""

LISTING = """
import sys, tasks
print(tasks.names(), tasks.start_set_names(), tasks.pairs(), len(tasks.start_set("poles")))
print("mujoco" in sys.modules)
print(tasks.load("dropped-in", tasks.start_set("only-one")[0]).reset().observation["R"].tolist())
print([len(tasks.start_set(name, 8, arm="dropped-arm")) for name in tasks.start_set_names(arm=True)])
print(tasks.load("arm-regulation", arm="dropped-arm").reset().observation["q"].shape)
"""


def test_dropped_files_are_found_without_a_simulator_and_run(tmp_path):
    copy = tmp_path / "tasks"
    shutil.copytree(Path(tasks.__file__).parent, copy, ignore=shutil.ignore_patterns("__pycache__"))
    (copy / "domains/dropped_in.py").write_text(TASK_FILE)
    (copy / "domains/geometry.py").write_text("LENGTH = 1.0\n")  # no constant TASK: no task
    (copy / "starts/only_one.py").write_text(STARTS_FILE)
    (copy / "arms/dropped_arm.xml").write_text((copy / "arms/ur5e.xml").read_text().replace(".425", ".35"))
    done = subprocess.run([sys.executable, "-c", LISTING], cwd=tmp_path, capture_output=True, text=True, check=True)
    names, simulated, R, counts, q = done.stdout.splitlines()
    assert "'dropped-in'" in names
    assert "geometry" not in names
    assert "'only-one'" in names
    assert "('arm-regulation', 'dropped-arm')" in names
    assert simulated == "False"
    assert R == "[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]"
    assert counts == str([8] * len(tasks.start_set_names(arm=True)))
    assert q == "(6,)"


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
