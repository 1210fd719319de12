"""A goal that jumps while the body moves, as in goal_jump, and the law's memory is reset at the jump."""

from tasks.conditions import goal_jump

AXIS = goal_jump.AXIS._replace(
    name="goal-jump-reset",
    title="Goal that jumps, memory reset",
    fields=(),
    sets=lambda level: {"jump_s": level, "jump_resets": int(level > 0.0)},
)
