"""Regressions: what a change does to outcomes, operations, instructions and time (`python -m bench compare`).

Outcomes and operations are exact, and instructions repeat to a few parts in a million: one run of each side decides.
Time does not: on a shared machine the same code differs by half from one run to the next. So both sides are timed in
one run, round by round in turn, and only what is slower by a tenth beyond chance, twice, is called slower.

comparison       what one comparison says, and its JSON
measurement      one side's own numbers: time over the reference kernel, instructions, operations
side             the process that compiles and times one checkout's laws; run by path, with no import of this package
process          that process as its parent sees it
machine          what it compiles for
alternating      base and head in turn, round by round
rule             from rounds to a verdict
instructions     what callgrind counts, and the small process that it counts in
commits          what BASE and HEAD mean, and checkouts that go away again
checkouts        base and head made ready: sources, law files, finished runs
exact            two runs, row by row, in words
measured         the gates of instructions and time
gates            all of it, gate after gate
summary          tables, and Markdown for a pull request
self_measure     a checkout's own measurements alone, as a history keeps them
"""
