"""Theorems about laws, proved from their source: one file each, with a constant THEOREM, in the laws' own symbols.

trace            a law's source, called with symbols, is a rational function on each path through its branches
body, question   a free body in those symbols, and questions to all paths of a law
solver           Z3, which decides inequalities of polynomials
theorem          what a theorem says of a law; `prove` finds the one that fits
settling_time    bounds of the longest settling time from rest, by interval arithmetic (flow)
sampled          when a law that is held between ticks is stable near its goal
certificate      all of it for one law, in a process of its own, as `bench prove` prints it and results/proofs has it

The proofs say that V falls, where it stays, and when a side changes. That the body then comes to the goal is LaSalle's
theorem, and that a set of starts has measure zero follows from its instability: both are cited, not checked.
"""
