"""The tasks by the words of dm_control.suite."""

import pytest

import tasks
from tasks import suite


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
