"""A goal oscillating about two axes, at a peak rate of the level; its rate is feedforward, its acceleration is not."""

from tasks.conditions import moving_goal
from tasks.moving_goal import RATE

AXIS = moving_goal.AXIS._replace(
    name="moving-goal-rate",
    title="Moving goal, feedforward of its rate",
    fields=(),
    sets=lambda level: {"reference_amplitude": level, "feedforward": RATE},
)
