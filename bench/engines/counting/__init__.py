"""What a law costs per tick, counted from the code that runs: by operation and by stage.

A law is called with counting scalars instead of floats. They carry the same IEEE 754 numbers, so the call
takes the same branches and returns the same bits, and they tally every operation they take part in.
"""
# ruff: noqa: F401  the face of the folder

from bench.engines.counting.costs import BRANCHES, Cost, cost, flops, rows
from bench.engines.counting.counted import OPERATIONS, STAGES, TOTAL, Counted, Counts, OutsideDialect, Tally
from bench.engines.counting.on_arms import rows_on_arm

RULES = (
    "In each control step, all inputs of a law count as variables, also the goal R_d and the gains.",
    "Operations count as written: an expression that occurs twice counts twice, unless the code stores its result.",
    "A subtraction counts as an addition. A change of sign (-x) is free, because it only changes one bit.",
    "A multiplication by a constant counts, even if the constant is 1 or 0. An operation on "
    "constants alone does not count.",
    "A call of sqrt counts as one floating-point operation (flop). Calls of sin, cos, acos and "
    "atan2 are counted separately, in one column for each function.",
    "Each of < <= > >= counts as one comparison. After a comparison, we count only the branch that the law takes.",
    "A stage is a part of the control step, for example the law or the Jacobian. The operations of a function count "
    "in the stage that calls the function. Functions of the coordinates, such as the conversion from the matrix, "
    "have separate stages.",
    "The typical count is the most frequent count for uniformly distributed orientations of the body, at "
    "rest and spinning. On an arm the typical count is the median of the counts for all starts, because the "
    "number of steps of an iterated inverse depends on the matrix.",
    "The worst count is the count in the state (orientation and speed) in which the law needs the most operations, "
    "all kinds added. We compare all states, also states that we chose because a law may take a rare branch there. "
    "If a law needs equally many operations in two states, we take the count with more flops.",
    "A law with memory is counted three times in each state: first with the initial memory, then with the "
    "memory that the law stored in the previous state, and last with the memory that the law stored in this state. "
    "Only the last of these counts is used for the typical count.",
)
"""The count rules, in the order the report states them."""
