"""What a law costs per tick, counted from the code that runs: by operation and by stage.

A law is called with counting scalars instead of floats. They carry the same IEEE 754 numbers, so the call
takes the same branches and returns the same bits, and they tally every operation they take part in.
"""
# ruff: noqa: F401  the face of the folder

from bench.engines.counting.costs import BRANCHES, Cost, cost, flops, rows
from bench.engines.counting.counted import OPERATIONS, STAGES, TOTAL, Counted, Counts, OutsideDialect, Tally
from bench.engines.counting.on_arms import rows_on_arm

RULES = (
    "All inputs of a law are variables in each control step, also the goal R_d and the gains.",
    "Operations count as written: an expression that occurs twice costs once if the law stores its result, else twice.",
    "A subtraction counts as an addition. A change of sign (-x) is free, because it only changes one bit.",
    "A multiplication by a constant counts, also by 1 or 0; an operation on constants alone does not count.",
    "sqrt counts as a flop; sin, cos, acos and atan2 each have a column, and no column is a weighted sum of them.",
    "Each of < <= > >= counts as one comparison; only the branch that the law takes is counted.",
    "A function that a law calls counts in the stage of the call, unless it belongs to the representation.",
    "Typical is the most frequent count over uniformly distributed orientations, at rest and spinning. On an arm it is "
    "the median over the starts, because the number of steps of an iterated inverse depends on its matrix.",
    "Worst is the largest number of operations of any kind over all states, directed states included. Of equal "
    "numbers we take the count with more flops, and then the count that came first.",
    "A law with memory is counted in each state with three memories: the initial memory, the memory after the state "
    "before, and the memory after this state. Only the last of these counts enters the typical branch.",
)
"""The count rules, in the order the report states them."""
