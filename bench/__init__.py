"""Orientation regulators on a free body and on arms: laws, engines, costs, results. Way in: `python -m bench --help`.

Rooms, bottom up; each imports only from rooms above it in this list (pyproject.toml says so, and `make lint` looks):

law/          what a law is: the dialect, rotations, linear algebra, records. `from bench.law import Regulator, kernel`
audit/        anybody's orientation error: pairs, convention, faults/ (one file each), report; knows nothing of laws
contenders/   the contestants, one file each: regulators/ representations/ jacobians/ inverses/ impedances/
              springs/, laws with a state of their own: compensators/,
              what others run: shipped/; registry finds them, combinations says what goes together; a user's own:
              law_file runs it, law_process where, described_law is what everybody else knows of it
control/      contenders at work: resolved_acceleration (tau = D J^-1 (u - Jdot qdot) + fg), velocity (omega = K f),
              hybrid, impedance, unshaped (an impedance with the hand's own inertia), contact_controller, registry
engines/      one episode, four ways: reference, native, ideal-rk4, ideal-held; disturbed, and commanded by velocities
metrics/      what is measured: motion/ along an episode, contact/ of a hand in contact, over contact_force and
              measured_compliance
counting/     operations of the code that runs
tables/       schema, store, files, read, statistics, lock; trust and kept_laws (laws of a results folder that may run)
experiments/  one file an experiment: free_body, arm, contact, robustness, velocity, velocity_limits, impedance,
              impedance_modes, springs, pose_springs, compensators, goal_streams, traces, boundaries, command_field,
              shipped, jacobians, costs; what plans them (experiment, plan, suites, choice); rows/ (engines' results)
running/      run, run_folder (until it is finished), order, precompile, sandbox (a user's laws), wire_format,
              schedulers/ (threads, and a Dask cluster), finish (the tables)
timing/       time per tick (pytest-benchmark)
findings/     claims/ (the paper's sentences), selection/ (which law), why (what a law does), theory/ (closed forms)
regression/   rows/ (two runs), revisions/ (two revisions), history (every build)
export/       laws as code for another's controller: C, C++, Python, JavaScript, with test vectors
questions/    what users of robot libraries asked in public, one case a file
studies/      scale (what many episodes cost), settings (other processors), libraries/ (other robot libraries), gates
cli/          the command line, one file a command

Beside them errors (each says its cure) and provenance (where numbers come from, and where caches are kept). The judge
(plants, arms, starts, rules, truth) is the package `tasks`, which imports nothing from here; the book is `report`,
which nothing here imports.
"""
