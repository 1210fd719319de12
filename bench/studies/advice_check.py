"""Does the advice hold between the situations of the map? results/advice-check, and three shares.

COUNT situations are drawn over the whole ranges of the map's numbers, all at once, so that unstable loops are among
them. In each, `bench advise` is asked; then every law is simulated from the same starts, as by `--run`, and the advised
law from other starts. SEED was committed before any of them was run.
"""

import math
import time
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bench.experiments.situations import mapped_laws
from bench.experiments.tables.schema import RESULTS
from bench.findings.selection.advice import MOST, Trials, advise, choose, list_qualified, may_be_advised
from bench.findings.selection.advice import SEED as STARTS_SEED
from bench.findings.selection.checked import OUT
from bench.findings.selection.regions import RULE
from bench.studies.study import keep_table, make_parser, make_parts
from tasks.situation import COORDINATES, Situation, rounded

COUNT, SEED = 100, 20261207

NONE = 0.25
"""Chance that a situation has no bound, and no spin, and no jump."""


def draw(count: int, seed: int) -> list[Situation]:
    """Draw situations, each number anywhere between its extreme levels; ratios by their logarithm."""
    rng = np.random.default_rng(seed)
    situations = []
    for _ in range(count):
        values = []
        for name, coordinate in COORDINATES.items():
            finite = [level for level in coordinate.levels if math.isfinite(level)]
            low, high = min(finite), max(finite)
            place, absent = rng.random(2)
            if coordinate.is_ratio:
                value = low * (high / low) ** place
            else:
                value = low + (high - low) * place
            is_absent = name in ("bound", "spin", "jump") and absent < NONE
            values.append(coordinate.nominal if is_absent else value)
        situations.append(rounded(values))
    return situations


def check(at: Situation) -> dict[str, Any]:
    """Return the row of a situation."""
    began = time.process_time()
    trials = Trials(at, STARTS_SEED)
    advice = advise(at, trials=trials)
    cpu = time.process_time() - began
    printed, large = math.inf, math.inf
    if advice.law:
        printed = float(advice.row(advice.law)["time"])
        large = float(Trials(at, STARTS_SEED + 1).run(advice.law, MOST).row["time"])
    best, best_time, qualified = find_best(trials)
    return {
        "situation": at.word,
        "radius": advice.near_goal.radius,
        "hopeless": int(advice.near_goal.is_hopeless),
        "advised": advice.law or "none",
        "printed": printed,
        "large": large,
        "qualified": qualified,
        "best": best,
        "best_time": best_time,
        "cpu": cpu,
    }


def find_best(trials: Trials) -> tuple[str, float, int]:
    """Return the fastest law that may be advised, its time, and how many there are; all laws are simulated.

    Among those that nothing beats, for these alone have run from MOST starts.
    """
    every = [law.name for law in mapped_laws()]
    if choose(trials, every, RULE, None) is None:
        return "none", math.inf, 0
    rows = trials.rows()
    qualified = [law for law in list_qualified(rows, RULE) if may_be_advised(law)]
    times = rows.set_index("contender")["time"]
    best = min((law for law in qualified if len(trials.by_law[law].times) >= MOST), key=lambda law: times[law])
    return best, float(times[best]), len(qualified)


def main() -> None:
    """Run the study."""
    out: Path = make_parser("advice_check", __doc__, out=RESULTS / OUT).parse_args().out
    situations = draw(COUNT, SEED)
    parts = {at.word: lambda at=at: check(at) for at in situations}
    out.parent.mkdir(parents=True, exist_ok=True)
    made = make_parts(out, parts)
    keep_table("advice_check", out, pd.DataFrame(list(made.values())), seed=SEED, situations=COUNT)


if __name__ == "__main__":
    main()
