"""Orientation regulators on one plant: laws, engines, costs, results. `python -m bench --help` is the way in.

What a law is      scalar (the dialect), so3, contender (Gains, Goal, Representation, Regulator, Contender)
The contestants    regulators/, representations/ (one file each), discovery (finds them, and a user's file)
Running            engines/ (reference, native, ideal-rk4, ideal-held), metric, metrics/
A run              suites, plan, run (threads, resume), rows, traces, boundary, counting, schema, store, provenance
Reading results    claims/ (the paper's sentences), compare (the regression gate), figures/ (for the report)
Time               timing/ (pytest-benchmark)
The command line   cli/ (one file a command)

The judge (plants, starts, rules, truth) is the package `tasks`, which imports nothing from here.
"""
