"""Operations of our own laws, kept on disk.

Counting all laws takes ten seconds, more than a run of one law; a user's own is counted anew each time.
"""

from bench import counting
from bench.law.contender import Contender
from bench.tables.kept_rows import Rows, kept


def of_law(contender: Contender) -> Rows:
    """Rows of costs.parquet of a law alone."""
    if contender.regulator.origin:
        return counting.rows([contender])
    return kept(f"costs/{contender.name}", lambda: counting.rows([contender]))


def of_controller(contender: Contender, joints: int) -> Rows:
    """Those of a controller on so many joints."""
    if contender.regulator.origin:
        return counting.rows_on_arm(contender, joints)
    return kept(f"costs/{contender.name}-{joints}", lambda: counting.rows_on_arm(contender, joints))
