"""Compile our own code that users' laws run in, in a process without them, before the first of them needs it.

A process that runs a user's law keeps nothing that it compiles (bench/engines/kept_code.py). Without this module each
such process would compile our loops again, for seconds. So a process of this module compiles them for a law of ours
that takes the place of the user's, and keeps them; the user's process then loads them.

A mark beside the code says that this was done, so that a later run starts no process for it. The mark saves time and
nothing else: what a law's process does not find it compiles for itself.
"""

import contextlib
import dataclasses
import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterable
from pathlib import Path

import tasks
from bench.base.errors import BenchError
from bench.base.processes import module_command
from bench.engines import cache
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.law.contender import Contender, refusal
from bench.law.contenders import registry
from bench.law.kinds import ACTUATOR, COSTING
from bench.running.precompile import end_without
from bench.running.wire_format import described, plan_of

LONGEST_S = 600.0
"""On the wall, for all of it: as long as a law's process may take to start and to compile (sandbox.pool.READY)."""

UNCOMPILED = "reference"
"""The engine that runs plain Python."""


def compile_ours(plan: Plan, units: Iterable[Unit]) -> None:
    """Compile what these units of users' laws need of our code, unless it was done before."""
    wanted = {}
    for unit in units:
        ours = in_our_place(unit)
        if ours is not None and not mark_of(ours).exists():
            wanted[mark_of(ours)] = ours
    if not wanted:
        return
    without_users = Plan(dataclasses.replace(plan.request, laws=()), tuple(wanted.values()))
    content = json.dumps(described(without_users, without_users.units)).encode()
    command = module_command(__name__, str(os.getpid()))
    nowhere = subprocess.DEVNULL
    # If it does not come to its end, the law's process compiles for itself, and says what is wrong.
    with contextlib.suppress(subprocess.TimeoutExpired):
        subprocess.run(
            command,
            input=content,
            stdout=nowhere,
            stderr=nowhere,
            timeout=LONGEST_S,
            start_new_session=True,
            check=False,
        )


def in_our_place(unit: Unit) -> Unit | None:
    """Return a unit of a law of ours that needs the same loops; None where nothing is compiled."""
    if unit.engine == UNCOMPILED:
        return None
    law = find_stand_in(unit)
    if law is None:
        return None
    # Without a start set none is built; a total of 0 keeps a law of ours from being compiled into loops of its own.
    return dataclasses.replace(unit, contender=law.name, selector="", first=0, count=0, total=0, episodes=0, kp=0, kv=0)


def find_stand_in(unit: Unit) -> Contender | None:
    """Return a law of ours on the same coordinates, which goes with the same Jacobian and inverse."""
    word, _, way = unit.contender.partition("@")
    coordinates = word.partition("/")[2]
    for law in (*registry.papers_laws(), *registry.all_contenders()):
        its_coordinates = law.representation.name if law.representation else ""
        if its_coordinates != coordinates or law.regulator.role in (ACTUATOR, COSTING):
            continue
        if not unit.arm:
            return law
        controller = on_arm(law, way)
        if not refusal(controller, tasks.arm(unit.arm).joints):
            return controller
    return None


def on_arm(law: Contender, way: str) -> Contender:
    """Return a law by a way `jacobian+inverse`."""
    by, _, through = way.partition("+")
    return law._replace(jacobian=registry.jacobian(by), inverse=registry.inverse(through))


def mark_of(unit: Unit) -> Path:
    """Return the file that says that the code of a unit of ours is kept."""
    return cache.mark_of((unit.experiment, unit.contender, unit.engine, unit.arm, unit.variation))


def main(parent: int, content: dict) -> None:
    """Compile what each unit needs, and mark it, as long as the process that asked is there."""
    threading.Thread(target=end_without, args=(parent,), daemon=True).start()
    plan = plan_of(content)
    for unit in plan.units:
        with contextlib.suppress(BenchError, OSError):
            experiment_of(unit).prepare(plan.request, unit)
            mark = mark_of(unit)
            mark.parent.mkdir(parents=True, exist_ok=True)
            mark.touch()


if __name__ == "__main__":
    main(int(sys.argv[1]), json.load(sys.stdin))
