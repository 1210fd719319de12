"""One file adds a task or a start set; unknown names say what there is."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import tasks
from tasks.base import StartSet, Task, UnknownName

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
import tasks
print(tasks.names(), tasks.start_set_names())
environment = tasks.load("dropped-in", tasks.start_set("only-one")[0])
print(environment.reset().observation["R"].tolist())
"""


@pytest.fixture
def copy_of_tasks(tmp_path) -> Path:
    shutil.copytree(Path(tasks.__file__).parent, tmp_path / "tasks", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


def test_dropped_file_is_found_and_runs(copy_of_tasks):
    (copy_of_tasks / "tasks/domains/dropped_in.py").write_text(TASK_FILE)
    (copy_of_tasks / "tasks/starts/only_one.py").write_text(STARTS_FILE)
    done = subprocess.run(
        [sys.executable, "-c", LISTING], cwd=copy_of_tasks, capture_output=True, text=True, check=True
    )
    assert "'dropped-in'" in done.stdout
    assert "'only-one'" in done.stdout
    assert "[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]" in done.stdout


def test_file_without_the_constant_is_no_task(copy_of_tasks):
    (copy_of_tasks / "tasks/domains/geometry.py").write_text("LENGTH = 1.0\n")
    done = subprocess.run(
        [sys.executable, "-c", "import tasks; print(tasks.names())"],
        cwd=copy_of_tasks,
        capture_output=True,
        text=True,
        check=True,
    )
    assert "geometry" not in done.stdout


def test_names_are_file_names_with_dashes():
    assert "free-body" in tasks.names()
    assert isinstance(tasks.task("free-body"), Task)


def test_start_sets_of_the_design_are_there():
    known = {"paper", "uniform", "half-turn", "poles", "wraps", "box", "tumbling", "goals"}
    assert known <= set(tasks.start_set_names())


@pytest.mark.parametrize("call", [tasks.task, tasks.load])
def test_unknown_task_lists_the_known_ones(call):
    with pytest.raises(UnknownName, match=r"task 'puma' is not in tasks/domains; known: .*free-body.*\(use one"):
        call("puma")


def test_unknown_start_set_lists_the_known_ones():
    with pytest.raises(UnknownName, match=r"start set 'corners' is not in tasks/starts; known: .*half-turn"):
        tasks.start_set("corners")


def test_unknown_integrator_lists_the_known_ones():
    with pytest.raises(UnknownName, match=r"integrator 'midpoint'.*known: euler, implicit, implicitfast, rk4"):
        tasks.load(integrator="midpoint")


def test_task_of_the_callers_own_is_loaded():
    own = tasks.task("free-body")._replace(name="own")
    assert tasks.load(own).task.task.name == "own"


def test_model_without_the_sensors_is_refused():
    free_body = tasks.task("free-body")
    blind = free_body._replace(
        name="blind", xml=lambda dt: free_body.xml(dt).replace('name="n" objtype', 'name="m" objtype')
    )
    with pytest.raises(ValueError, match=r"task 'blind': .*sensor_xml"):
        tasks.load(blind)


def test_start_set_types_are_named_as_their_files():
    from tasks import starts
    from tasks.discovery import constants

    for name, found in constants(starts, "STARTS").items():
        assert isinstance(found, StartSet)
        assert found.name == name


def test_loading_writes_nothing_to_stderr():
    """Without a display, GLFW would warn as dm_control looks for a renderer that the judge never uses."""
    environ = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "MUJOCO_GL")}
    command = [sys.executable, "-c", "import tasks; tasks.load().reset()"]
    done = subprocess.run(command, env=environ, capture_output=True, text=True, check=True)
    assert done.stderr == ""
