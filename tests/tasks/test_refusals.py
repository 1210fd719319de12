"""The judge finds tasks, arms and start sets by name, or refuses in one line with the known names or the cure."""

import math
import os
import subprocess
import sys
from functools import partial

import pytest

import tasks
from tasks import starts, suite
from tasks.base import StartSet
from tasks.discovery import constants
from tasks.errors import BadValue, UnknownName

NAN = (0.0, 0.0, math.nan, 0.0, 0.0, 0.0)


def on_ur5e(start_set="tumbling", of="ur5e", **fields):
    """A UR5e is loaded with the first start of a set, perhaps of another arm's, some of its fields changed."""
    tasks.load("arm-regulation", tasks.start_set(start_set, 1, arm=of)[0]._replace(**fields), arm="ur5e")


UNKNOWN = [
    (partial(tasks.task, "puma"), r"task 'puma' is not in tasks/domains; known: .*free-body.*\(use one"),
    (partial(tasks.task, "crank"), r"task 'crank' is one in contact \(try: tasks.load\('crank', arm='"),
    (partial(tasks.arm, "ur6"), r"arm 'ur6' is not in tasks/arms; known: .*puma560.*ur5e.*\(use one"),
    (partial(tasks.task, "arm-regulation", "ur6"), r"arm 'ur6' is not in tasks/arms; known: .*ur5e"),
    (partial(tasks.start_set, "clear", arm="ur6"), r"arm 'ur6' is not in tasks/arms"),
    (partial(tasks.start_set, "corners"), r"start set 'corners' is not in tasks/starts; known: .*half-turn"),
    (partial(tasks.start_set, "clear"), r"start set 'clear' is not in tasks/starts; known: box"),
    (partial(tasks.start_set, "paper", arm="ur5e"), r"start set 'paper' is not in tasks/arm_starts; known: clear"),
    (partial(tasks.load, integrator="midpoint"), r"integrator 'midpoint'.*known: euler, implicit, implicitfast, rk4"),
    (partial(tasks.variation, "heavier"), r"variation 'heavier' .*mass-1.30"),
    (partial(tasks.axis, "bad-luck"), "control-rate"),
]
BAD = [
    (partial(tasks.task, "arm-regulation"), r"task 'arm-regulation' needs an arm; known: .*ur5e.* \(try: arm='"),
    (partial(tasks.load, "crank"), r"task 'crank' needs an arm; known: .*ur5e.* \(try: arm='ur5e'"),
    (partial(tasks.load, "crank", arm="jaco"), r"arm 'jaco' has no site 'wrist', where task 'crank' mounts the hand"),
    (partial(tasks.load, "crank", tasks.start_set("paper")[0], arm="ur5e"), r"is no trial .*\(try: tasks.contact_task"),
    (partial(tasks.load, "crank", arm="ur5e", dt=0.0), r"dt = 0.0 s is not a control period"),
    (partial(tasks.task, "free-body", "ur5e"), r"'free-body' has no arm, but 'ur5e' was named .*arm-regulation\)"),
    (partial(tasks.start_set, "uniform", -3), r"count .* at least 1 \(try: count=10\)"),
    (partial(tasks.start_set, "clear", 0, arm="ur5e"), r"count .* at least 1 \(try: count=10\)"),
    (partial(on_ur5e, "paper", ""), r"q = \(\) must be 6 finite numbers on arm 'ur5e' \(try: .*'clear', arm='ur5e'"),
    (partial(on_ur5e, of="panda"), r"must be 6 finite numbers on arm 'ur5e'"),
    (partial(on_ur5e, q=NAN), r"q = .*finite"),
    (partial(on_ur5e, qdot=NAN), r"qdot = .*finite"),
]


@pytest.mark.parametrize(
    ("error", "call", "says"), [*((UnknownName, *one) for one in UNKNOWN), *((BadValue, *one) for one in BAD)]
)
def test_unknown_name_lists_the_known_ones_and_a_bad_value_is_refused_with_the_cure(error, call, says):
    with pytest.raises(error, match=says):
        call()


def test_model_without_the_sensors_is_refused():
    free_body = tasks.task("free-body")
    blind = free_body._replace(name="blind", xml=lambda dt: free_body.xml(dt).replace('"n" objtype', '"m" objtype'))
    with pytest.raises(ValueError, match=r"task 'blind': .*sensor_xml"):
        tasks.load(blind)


def test_start_set_types_are_named_as_their_files():
    for name, found in constants(starts, "STARTS").items():
        assert isinstance(found, StartSet)
        assert found.name == name
    assert all(tasks.find_start_set(name, arm=True).title for name in tasks.start_set_names(arm=True))


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
