"""A goal that jumps while the body moves, as in goal_jump, and the law's memory is reset at the jump."""

from tasks.axis import Axis
from tasks.conditions.goal_jump import starts

AXIS = Axis(
    "goal-jump-reset",
    "Goal that jumps, memory reset",
    "s",
    (0.0, 0.05, 0.1, 0.2, 0.5, 1.0),
    0.0,
    sets=lambda level: {"jump_s": level, "jump_resets": int(level > 0.0)},
    starts=starts,
)
