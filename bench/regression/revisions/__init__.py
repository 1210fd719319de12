"""Compare two states of the code: outcomes, operations, a user's faults, and time (`python -m bench compare`).

Outcomes and operations are exact: one run of each side decides. Time is not: on a shared machine the same code differs
by half from one run to the next. So both sides are timed in turn, and only what is slower by a tenth beyond chance,
twice, is called slower.

gates        the whole comparison, gate after gate
commits      what BASE and HEAD mean, and temporary checkouts
checkouts    base and head made ready: sources, law files, finished runs
exact        two runs, row by row, in words
timed        the program that times one side
timing       both sides in turn, and the verdict
comparison   the records of what was found
summary      tables, and Markdown for a pull request
"""
