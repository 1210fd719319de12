"""Does a constant of ours decide a law's rank? Laws with other values of their constants: results/constants.

The nominal situation, and DRAWN drawn by SEED, which is committed before the study is run. Every law of the map is run
as shipped, and each law of `bench.findings.constants.CONSTANTS` with other values, all from the same starts. A
situation is kept as soon as all its laws have run, so that a call that was stopped goes on.
"""

import functools
import math
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np

from bench.engines.episode import OUTCOME, SETTLING_TICK
from bench.engines.episode import Settings as Limits
from bench.engines.plants import perturbed
from bench.engines.simulate_bodies import run_disturbed
from bench.experiments.situations import CROWD, HORIZON_S, mapped_laws, metrics
from bench.experiments.tables.statistics import quantile
from bench.findings.constants import AS_SHIPPED, CONSTANTS, STUDY, Constant
from bench.findings.selection.regions import NAMES
from bench.law.contender import Contender
from bench.law.contenders.law_file import keep_text, load_law
from bench.law.contenders.registry import contenders
from bench.law.inputs import Gains
from bench.studies.situations import draw
from bench.studies.study import make_table
from tasks.base import Start
from tasks.situation import KP, NOMINAL, Situation
from tasks.verdict import SETTLED

DRAWN, SEED = 20, 20261128
"""Situations drawn, and the seed of the draw."""

STARTS, STARTS_SEED = 400, 0
"""Starts of a situation, the same for every law."""


def law_with(constant: Constant, value: float) -> Contender:
    """Return a law whose file says another value of one constant; the file is read, and only that line is another."""
    file = Path(sys.modules[contenders("regulators")[constant.law].law.__module__].__file__ or "")
    text = file.read_text(encoding="utf-8")
    line = f"{constant.name} = {value!r}\n"
    text, count = re.subn(rf"^{constant.name} = .*\n", line, text, flags=re.MULTILINE)
    if not count:
        # The constant is imported: it is said again before the first function.
        text = text.replace("@kernel\n", f"{line}\n\n@kernel\n", 1)
    word = re.sub(r"[^a-z0-9]+", "-", f"{constant.law}-{constant.name.lower()}-{value:g}")
    text = text.replace(f'name="{constant.law}"', f'name="{word}"')
    return Contender(load_law(keep_text(text)))


@functools.lru_cache(maxsize=1)
def starts_of(situation: Situation) -> list[Start]:
    """Return the starts of a situation, made once for all its laws."""
    return situation.starts(STARTS, STARTS_SEED)


def settling_times(contender: Contender, situation: Situation) -> np.ndarray:
    """Return the settling time of each start, times sqrt(kp); infinite of one that does not settle."""
    limits = Limits(Gains(KP, situation.kv), 1e-6, round(1e6 * HORIZON_S), 1)
    condition = situation.condition()
    rows = run_disturbed(contender, starts_of(situation), condition, limits, metrics())
    step_s = condition.period_s / perturbed.steps_of(condition)
    return np.where(rows[:, OUTCOME] == SETTLED, rows[:, SETTLING_TICK] * step_s * math.sqrt(KP), math.inf)


@functools.cache
def every_law() -> tuple[tuple[str, str, float, Contender], ...]:
    """Return (law, constant, value, contender) of every law as shipped and with each other value of a constant."""
    shipped = [(one.name, AS_SHIPPED, 0.0, one) for one in mapped_laws()]
    varied = [
        (constant.law, constant.name, value, law_with(constant, value))
        for constant in CONSTANTS
        for value in constant.others
    ]
    return (*shipped, *varied)


def rows_in(situation: Situation) -> list[dict[str, Any]]:
    """Return a row a law and value in one situation."""
    rows = []
    for law, constant, value, contender in every_law():
        times = settling_times(contender, situation)
        rows.append(
            {
                "regulator": law,
                "constant": constant,
                "value": value,
                "situation": situation.word,
                "starts": len(times),
                "lost": int(np.isinf(times).sum()),
                "time": float(quantile(times, CROWD)),
            }
        )
    return rows


def situations() -> list[Situation]:
    """Return the nominal situation and the drawn ones."""
    return [NOMINAL, *draw(DRAWN, SEED, NAMES)]


if __name__ == "__main__":
    parts = {situation.word: functools.partial(rows_in, situation) for situation in situations()}
    make_table("constants", __doc__, STUDY / "constants.parquet", parts)
