"""What `show` says of a run in at most 40 lines: which law, its exceptions, the claims, what failed, where to look.

answer.py     the law that a run's numbers name, and the needs that name another
failures.py   what did not settle, part by part
whole.py      all of it: the claims, what the run does not hold, and where to look next
"""
