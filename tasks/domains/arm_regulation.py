"""An arm that turns its tool to the goal and holds its position, or moves it (Murphy 1988, 2.1 to 2.3 and 3.7).

    D(q) qddot + fg(q, qdot) = tau,   xdot = J(q) qdot

The command is the motors' torques tau [N m], in joint order. The plant has gravity; it has no contact, no joint
limits and no torque limits, so that an arm that is driven out of its range shows it in the results and nowhere else.
"""

from __future__ import annotations

import functools

from tasks.arm_model import Arm, model_xml
from tasks.base import ArmTask, Task


@functools.cache
def on(arm: Arm) -> Task:
    """Return the task on one arm."""
    return Task(
        name=TASK.name,
        title=TASK.title,
        source=arm.source,
        xml=lambda dt: model_xml(arm, dt),
        state=lambda start: (start.q, start.qdot),
        start_sets=TASK.start_sets,
        arm=arm.name,
    )


TASK = ArmTask(
    name="arm-regulation",
    title="Hold the tool's position, turn it to the goal",
    source="Murphy 1988, equations 2.1 to 2.3 and 3.7",
    on=on,
    start_sets=("clear", "wrist", "pole", "half-turn", "uniform", "tumbling", "reach"),
)
