"""Rows of costs.parquet that are counted once for all processes: all laws take ten seconds."""

from bench.engines.counting.costs import rows
from bench.engines.counting.on_arms import rows_on_arm
from bench.engines.kept_rows import kept
from bench.law.contender import Contender


def count_once(one: Contender, joints: int = 0) -> list[dict]:
    """Count the operations of a law, or of a controller on so many joints; what is counted of ours stays on disk."""

    def count() -> list[dict]:
        return rows_on_arm(one, joints) if joints else rows([one])

    return count() if one.regulator.origin else kept(f"costs/{one.name}{f'-{joints}' if joints else ''}", count)
