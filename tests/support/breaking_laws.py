"""A user's law that breaks in some states: sound but for the lines given, in a plan beside a law of ours."""

from pathlib import Path

from bench.experiments import plan
from bench.experiments.choice import Choice
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of, find_contender
from support.user_law import spring_text


def plan_of(folder: Path, body: str, *, engine: str) -> plan.Plan:
    """Our law and a user's, with `body` before its return, from the same four starts."""
    return plan_of_laws(folder, {"mine": body}, engine)


def plan_of_laws(folder: Path, bodies: dict[str, str], engine: str) -> plan.Plan:
    """Our law and some of a user's."""
    laws = [find_contender("rotation-matrix")]
    for name, body in bodies.items():
        path = folder / f"{name}.py"
        path.write_text(spring_text(body, name=name))
        laws += contenders_of(described(path))
    choice = Choice(("free-body",), ("uniform",), (engine,), experiments=("free-body",))
    return plan.make("quick", laws, choice, count=4, horizon_s=0.05)
