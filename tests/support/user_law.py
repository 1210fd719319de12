"""The text of a user's law, which tests write into a file and name with --law, and a plan of one that breaks."""

from pathlib import Path

from bench.experiments import plan
from bench.experiments.request import Request
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of, find_contender

LAW = """
import math, os, sys, time
from bench.law import Law, atan2, dot, double_sine, kernel, sqrt, turn_quaternion

@kernel
def law(R, omega, goal, gains):
    {body}

REGULATOR = Law("{name}", "Mine", "none", "u", law)
"""
DAMPER = "return (-gains.kv * omega[0], -gains.kv * omega[1], -gains.kv * omega[2])"
SPRING = (
    "x = 0.5 * gains.kp * (R.o[2] - R.a[1]) + gains.kv * omega[0]",
    "y = 0.5 * gains.kp * (R.a[0] - R.n[2]) + gains.kv * omega[1]",
    "z = 0.5 * gains.kp * (R.n[1] - R.o[0]) + gains.kv * omega[2]",
)


def law_text(*body: str, name: str = "mine") -> str:
    """A law of these lines."""
    return LAW.replace("{body}", "\n    ".join(body)).replace("{name}", name)


def spring_text(*before: str, name: str = "mine") -> str:
    """The rotation-matrix law to the identity, with these lines before its return."""
    return law_text(*SPRING, *before, "return (-x, -y, -z)", name=name)


def plan_of(folder: Path, body: str, *, engine: str, count: int = 4) -> plan.Plan:
    """Plan our law and a user's, with `body` before its return, from the same starts."""
    path = folder / "mine.py"
    path.write_text(spring_text(body, name="mine"))
    laws = [find_contender("rotation-matrix"), *contenders_of(described(path))]
    request = Request(
        "quick",
        tuple(laws),
        count=count,
        horizon_s=0.05,
        tasks=("free-body",),
        start_sets=("uniform",),
        engines=(engine,),
        experiments=("free-body",),
    )
    return plan.make(request)
