"""A goal oscillating about two axes, at a peak rate of the level; the law is given where it is, without feedforward."""

from tasks.conditions import moving_goal
from tasks.moving_goal import NO_FEEDFORWARD

AXIS = moving_goal.AXIS._replace(
    name="moving-goal-untold",
    title="Moving goal, no feedforward",
    fields=(),
    sets=lambda level: {"reference_amplitude": level, "feedforward": NO_FEEDFORWARD},
)
