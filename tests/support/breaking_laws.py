"""Plan a user's law that breaks in some states together with one of ours."""

from pathlib import Path

from bench.experiments import plan
from bench.experiments.choice import Choice
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of, find_contender
from support.user_law import spring_text


def plan_of(folder: Path, body: str, *, engine: str) -> plan.Plan:
    """Plan our law and a user's, with `body` before its return, from the same four starts."""
    path = folder / "mine.py"
    path.write_text(spring_text(body, name="mine"))
    laws = [find_contender("rotation-matrix"), *contenders_of(described(path))]
    choice = Choice(("free-body",), ("uniform",), (engine,), experiments=("free-body",))
    return plan.make("quick", laws, choice, count=4, horizon_s=0.05)
