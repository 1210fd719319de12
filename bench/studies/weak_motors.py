"""How near is the advised law to the fastest motions where motors are weak? results/weak-motors.

COUNT situations are drawn with a bound of the command between 0.03 and 1 kp. The other numbers are drawn by the rule of
the map; bodies with unequal moments and goals that jump are left out, because the least time is not known for them. In
each, `bench advise` is asked. The row has the time and the overshoot of its law, and two times that no law can change:
that of the fastest motions of the bound, and that of the linear loop near the goal. SEED was committed before any of
the situations was run.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bench.experiments.tables.schema import RESULTS
from bench.findings.selection.advice import advise
from bench.findings.selection.checked import WEAK_OUT
from bench.studies.situations import DIFFERS
from bench.studies.study import keep_table, make_parser, make_parts
from tasks.situation import COORDINATES, Situation, rounded

COUNT, SEED = 200, 20261206

BOUNDS = 0.03, 1.0
"""Least and greatest bound of the command [kp]."""

DRAWN = ("zeta", "bound")
"""Numbers that are always drawn."""

VARIED = ("delay", "period", "inertia", "spin")
"""Numbers that are drawn with the chance DIFFERS, and nominal otherwise."""


def draw(count: int, seed: int) -> list[Situation]:
    """Draw situations with a bound; ratios by their logarithm."""
    rng = np.random.default_rng(seed)
    situations = []
    for _ in range(count):
        values = {name: coordinate.nominal for name, coordinate in COORDINATES.items()}
        for name in (*DRAWN, *VARIED):
            coordinate = COORDINATES[name]
            low, high = BOUNDS if name == "bound" else (min(coordinate.levels), max(coordinate.levels))
            place, is_other = rng.random(2)
            drawn = low * (high / low) ** place if coordinate.is_ratio else low + (high - low) * place
            if name in DRAWN or is_other < DIFFERS:
                values[name] = drawn
        situations.append(rounded(values.values()))
    return situations


def check(at: Situation) -> dict[str, Any]:
    """Return the row of a situation."""
    advice = advise(at)
    row = advice.row(advice.law) if advice.law else {"time": math.inf, "overshoot": math.nan}
    return {
        "situation": at.word,
        "bound": at.bound,
        "inertia": at.inertia,
        "advised": advice.law or "none",
        "time": float(row["time"]),
        "overshoot": float(row["overshoot"]),
        # No command has an effect before the delay has passed.
        "least": at.delay + advice.least,
        "linear": advice.near_goal.time,
    }


def main() -> None:
    """Run the study."""
    out: Path = make_parser("weak_motors", __doc__, out=RESULTS / WEAK_OUT).parse_args().out
    parts = {at.word: lambda at=at: check(at) for at in draw(COUNT, SEED)}
    out.parent.mkdir(parents=True, exist_ok=True)
    made = make_parts(out, parts)
    keep_table("weak_motors", out, pd.DataFrame(list(made.values())), seed=SEED, situations=COUNT)


if __name__ == "__main__":
    main()
