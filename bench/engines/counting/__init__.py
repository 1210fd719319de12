"""What a law costs per tick, counted from the code that runs: by operation and by stage.

A law is called with counting scalars instead of floats. They carry the same IEEE 754 numbers, so the call
takes the same branches and returns the same bits, and they tally every operation they take part in.
"""
# ruff: noqa: F401  the face of the folder

from bench.engines.counting.costs import BRANCHES, Cost, cost, flops, rows
from bench.engines.counting.counted import OPERATIONS, STAGES, TOTAL, Counted, Counts, OutsideDialect, Tally
from bench.engines.counting.on_arms import rows_on_arm

RULES = (
    "Everything a law is given varies each tick, the goal R_d and the gains included.",
    "Operations count as written: a common sub-expression costs once if the law names it, else each time.",
    "A subtraction is an add. Changing a sign (-x) is free: it flips one bit and computes nothing.",
    "Multiplying by a constant counts, by 1 or 0 too; an operation on constants alone does not.",
    "sqrt is a flop; sin, cos, acos and atan2 are columns of their own and never weighted into one.",
    "Each of < <= > >= is one compare; the branch that is taken is what is counted.",
    "A function called by a law counts in the stage of its caller, unless it is the representation's own.",
    "Typical is the tally most frequent over uniformly distributed orientations, at rest and spinning; on an arm the "
    "median over its starts, for an iterated inverse takes as many steps as its matrix needs.",
    "Worst is the largest number of operations of any kind over all states, directed ones included; between "
    "equals the one with more flops, then the one met first.",
    "A law with memory is counted with its initial memory, with what the state before left, and with what it "
    "then left itself; only the last enters the typical branch.",
)
"""The count rules, in the order the report states them."""
