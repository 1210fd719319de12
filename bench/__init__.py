"""Orientation regulators on a free body and on arms: laws, engines, costs, results. Way in: `python -m bench --help`.

What a law is      scalar (the dialect), so3, linalg/, contender (Gains, Goal, Representation, Regulator, Jacobian, ...)
The contestants    regulators/, representations/, jacobians/, inverses/ (one file each), discovery (finds them, and a
                   user's file)
On an arm          cartesian (tau = D J^-1 (u - Jdot qdot) + fg), chain, weighting, combinations (what goes together)
In contact         force (hybrid control), impedance, impedances/, compliance (a controller), contact_metric,
                   contact_metrics/ over touching and yielding, contact_plan, contact_rows
In trouble         tracking (goals that move), equal_peak, robustness_plan, robustness_rows, engines/disturbed
Running            engines/ (reference, native, ideal-rk4, ideal-held), metric, metrics/
A run              suites, choice, plan, run, journal (its folder until it is finished), schedulers/ (threads, and a
                   Dask cluster), work (a unit's rows), chunk (units as JSON, for other processes), finish (its
                   tables), ahead (a second process compiles), scale (what many episodes cost), rows, traces, boundary,
                   poses, counting/, schema, store, provenance
Reading results    claims/ (the paper's sentences), compare/ (two runs), regress/ (two revisions), history/ (every
                   build), figures/ (the report's), kept_laws and trust (laws of a results folder that may run)
Time               timing/ (pytest-benchmark)
The command line   cli/ (one file a command)

The judge (plants, arms, starts, rules, truth) is the package `tasks`, which imports nothing from here.
"""
