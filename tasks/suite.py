"""Load the tasks as `dm_control.suite` loads its own.

A domain is a task of this package. Its tasks are the names of the arms that it is done by, or "no-arm".
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import tasks
from tasks.contact import can_do

if TYPE_CHECKING:
    from dm_control.rl.control import Environment

NO_ARM = "no-arm"
WORDS = {"time_limit": "horizon", "control_timestep": "dt"}
"""Words of dm_control and what `tasks.load` calls them."""


def list_tasks() -> tuple[tuple[str, str], ...]:
    """Return every (domain_name, task_name), as ALL_TASKS of dm_control.suite."""
    every = map(tasks.contact_task, tasks.contact_names())
    contact = ((one.name, arm) for one in every for arm in tasks.arm_names() if can_do(one, tasks.arm(arm)))
    return (*((name, arm or NO_ARM) for name, arm in tasks.pairs()), *contact)


def load(
    domain_name: str,
    task_name: str,
    task_kwargs: Mapping[str, Any] | None = None,
    environment_kwargs: Mapping[str, Any] | None = None,
) -> Environment:
    """Return the environment of a task; words of `tasks.load` and of dm_control are taken in either of the two."""
    given = {
        WORDS.get(name, name): value for name, value in {**(task_kwargs or {}), **(environment_kwargs or {})}.items()
    }
    return tasks.load(domain_name, arm="" if task_name == NO_ARM else task_name, **given)
