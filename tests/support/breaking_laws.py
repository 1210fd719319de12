"""A user's law that breaks in some states: sound but for the lines given, in a plan beside a law of ours."""

from pathlib import Path

from bench.contenders.law_file import load_law
from bench.contenders.registry import contenders_of, find_contender
from bench.experiments import plan
from bench.experiments.choice import Choice

LAW = """
import os, sys, time
from bench.law.contender import Regulator
from bench.law.scalar import kernel

@kernel
def law(R, omega, goal, gains):
    x = 0.5 * gains.kp * (R.o[2] - R.a[1]) + gains.kv * omega[0]
    y = 0.5 * gains.kp * (R.a[0] - R.n[2]) + gains.kv * omega[1]
    z = 0.5 * gains.kp * (R.n[1] - R.o[0]) + gains.kv * omega[2]
    {body}
    return (-x, -y, -z)

REGULATOR = Regulator("{name}", "Mine", "none", "u", law)
"""


def plan_of(folder: Path, body: str, *, engine: str) -> plan.Plan:
    """Our law and a user's, with `body` before its return, from the same four starts."""
    return plan_of_laws(folder, {"mine": body}, engine)


def plan_of_laws(folder: Path, bodies: dict[str, str], engine: str) -> plan.Plan:
    """Our law and some of a user's."""
    laws = [find_contender("rotation-matrix")]
    for name, body in bodies.items():
        path = folder / f"{name}.py"
        path.write_text(LAW.replace("{body}", body).replace("{name}", name))
        laws += contenders_of(load_law(path))
    choice = Choice(("free-body",), ("uniform",), (engine,))
    return plan.make("quick", laws, choice, count=4, horizon_s=0.05)
