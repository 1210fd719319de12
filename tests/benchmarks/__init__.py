"""The benchmarks, and the only timer: `pytest tests/benchmarks --benchmark-only`.

`bench time`, `bench compare` and `bench history` run these files, too. pytest leaves them out
unless they are named.
"""
