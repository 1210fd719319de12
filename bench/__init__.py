"""Orientation regulators on a free body and on arms: laws, engines, costs, results. Way in: `bench --help`.

Rooms, bottom up; each imports only from rooms above it in this list (pyproject.toml says so, and `make lint` looks):

base/         errors (each says its cure), provenance (where numbers come from, where caches are kept), files, isolated
              (the process of a user's law or of an audited function)
law/          what a law is: the dialect, rotations, linear algebra, records. `from bench.law import Law, kernel`
              contenders/, one file each: regulators/ representations/ jacobians/ inverses/ impedances/ springs/, laws
              with a state of their own: compensators/, what others run: shipped/; registry finds them, combinations
              says what goes together; a user's own: law_file runs it, law_process asks about it, described_law
              describes it
              control/, contenders at work: resolved_acceleration (tau = D J^-1 (u - Jdot qdot) + fg), hybrid,
              velocity (omega = K f), impedance, unshaped (an impedance with the hand's own inertia), registry
audit/        anybody's orientation error: pairs, convention, faults/ (one file each), report, its own command line and
              pytest plugin; knows nothing of laws
translation/  one translator: what functions contain, the kinds of their expressions, text with braces,
              C of whole loops
engines/      one episode, four ways: reference, native, ideal-rk4, ideal-held; disturbed, and commanded by velocities
              metrics/, what is measured: motion/ along an episode, contact/ of a hand in contact
              counting/, operations of the code that runs
experiments/  one file an experiment with its columns, units and rows; what plans them: request, suites, plan
              tables/: run (reads a run), schema, store, statistics; trust and kept_laws (laws of a results folder)
export/       laws as code for another's controller: C, C++, Rust, Python, JavaScript;
              test vectors; wheel (the audit and all laws in Python)
running/      run, run_folder (until it is finished), precompile, wire_format,
              sandbox/ (a user's laws), schedulers/ (threads, and a Dask cluster)
findings/     claims/ (the paper's sentences), selection/ (which law), why (what a law does), theory/ (closed forms);
              kept: found once, and again when anything differs
regression/   rows/ (two runs), revisions/ (two revisions), history (every build), timer (time per tick)
studies/      what is run rarely: libraries/ (other robot libraries), restated/, real_time/,
              situations, verdicts, gates and others
cli/          the command line, one file a command

The judge (plants, arms, starts, rules, truth) is the package `tasks`, which imports nothing from here; the book is
`report`, which nothing here imports.

From Python: `bench.load("episodes", engine="ideal-rk4")`, `bench.advise(kp=400, kv=28)` and `bench.audit(my_error)`
(cli/notebook.py and audit/). `import bench` imports none of them; what is called first does.
"""

import importlib
from typing import Any

__all__ = [
    "advise",
    "audit",
    "load",
]


def __getattr__(name: str) -> Any:
    """Import a function of `__all__`; by `import_module`, so that no room depends on it by importing `bench`."""
    if name == "audit":
        return importlib.import_module("bench.audit")
    if name in __all__:
        notebook = importlib.import_module("bench.cli.notebook")
        return getattr(notebook, name)
    known = ", ".join(__all__)
    raise AttributeError(
        f"module 'bench' has no attribute '{name}'; it has {known}",
    )


def __dir__() -> list[str]:
    names = [
        *globals(),
        *__all__,
    ]
    return sorted(names)
