"""Which law is the best in which situation? The map of `bench advise`: results/situations.

Planes of the damping ratio and each other number; situations drawn at random, without jumps; then, for ROUNDS rounds,
points halfway between neighbours in a plane that get other advice. The held-out set (`--only held-out`) is drawn by
another seed, is run once, and decides nothing.
"""

import itertools
import math
import shutil
from collections.abc import Iterable
from operator import attrgetter
from pathlib import Path

import numpy as np
import pandas as pd

from bench.experiments.situations import mapped_laws, plan_of
from bench.experiments.tables.schema import table_of
from bench.experiments.tables.store import read
from bench.findings.selection.regions import NAMES, STUDY, Verdict, decide, is_drawn, with_words
from bench.running import run
from bench.studies.study import keep_table, make_parser
from tasks.situation import COORDINATES, NOMINAL, Situation, read_situation, rounded

ROUNDS, DRAWN, SEED = 2, 300, 1988
HELD_OUT, HELD_OUT_SEED = 60, 20261126
"""Number and seed of the held-out situations; published with the commit before they were run."""

DIFFERS = 0.35
"""Chance that a number of a drawn situation is not the nominal one; the damping ratio is always drawn."""

FINE = tuple(round(0.5 + 0.02 * k, 2) for k in range(36))
"""Damping ratios of the nominal line, along which each law is tuned."""


def planes() -> list[Situation]:
    """Return the situations of every plane of the damping ratio and one other number."""
    values = [{name: value} for name in NAMES[1:] for value in COORDINATES[name].levels]
    each = (NOMINAL._replace(zeta=zeta, **value) for value in values for zeta in COORDINATES["zeta"].levels)
    return list(dict.fromkeys((*each, *(NOMINAL._replace(zeta=zeta) for zeta in FINE))))


def draw(count: int, seed: int, names: Iterable[str]) -> list[Situation]:
    """Draw situations: each number of `names` nominal or anywhere between its levels, two others at least."""
    found: list[Situation] = []
    rng = np.random.default_rng(seed)
    while len(found) < count:
        values = dict(NOMINAL._asdict())
        for name in names:
            one = COORDINATES[name]
            finite = [level for level in one.levels if math.isfinite(level)]
            low, high = min(finite), max(finite)
            place, is_other = rng.random(2)
            drawn = low * (high / low) ** place if one.is_ratio else low + (high - low) * place
            values[name] = drawn if name == "zeta" or is_other < DIFFERS else one.nominal
        at = rounded(values.values())
        if is_drawn(at):
            found.append(at)
    return found


def between(verdicts: dict[Situation, Verdict]) -> list[Situation]:
    """Return the situations halfway between neighbours along a plane that get other advice."""
    found = []
    for name in NAMES[1:]:
        nominal = {"zeta": NOMINAL.zeta, name: getattr(NOMINAL, name)}
        plane = [at for at in verdicts if at._replace(**nominal) == NOMINAL]
        for along, across in (("zeta", name), (name, "zeta")):
            ordered = sorted(plane, key=attrgetter(across, along))
            for one, other in itertools.pairwise(ordered):
                a, b = getattr(one, along), getattr(other, along)
                is_line = getattr(one, across) == getattr(other, across) and math.isfinite(b)
                if is_line and verdicts[one].law != verdicts[other].law:
                    middle = math.sqrt(a * b) if COORDINATES[along].is_ratio else 0.5 * (a + b)
                    found.append(rounded(one._replace(**{along: middle})))
    return [at for at in dict.fromkeys(found) if at not in verdicts]


def run_lacking(rows: pd.DataFrame, situations: Iterable[Situation], folder: Path, workers: int) -> pd.DataFrame:
    """Return rows of every law in every situation: those that are there, and the others by a run, which may go on."""
    known = with_words(rows) if len(rows) else rows.assign(contender=[], situation=[])
    has = set(zip(known["contender"].astype(str), known["situation"], strict=True))
    pairs = [(one, at) for one in mapped_laws() for at in situations if (one.name, at.word) not in has]
    print(f"{folder.name}: {len(pairs)} laws in situations to run", flush=True)
    if not pairs:
        return rows
    run.run(plan_of(pairs), folder, workers=workers, replace=True)
    return pd.concat([rows, read(folder, "situations")], ignore_index=True)


def verdicts_of(rows: pd.DataFrame) -> dict[Situation, Verdict]:
    """Return the rule's verdict on every situation of some rows."""
    groups = with_words(rows).groupby("situation", sort=False, observed=True)
    return {read_situation(str(word)): decide(own) for word, own in groups}


def make_map(workers: int, folder: Path) -> pd.DataFrame:
    """Return the rows of the map: planes, drawn situations, then rounds of halfway points."""
    rows = kept(folder)
    every = [*dict.fromkeys((*verdicts_of(rows), *planes(), *draw(DRAWN, SEED, NAMES[:-1])))]
    for number in range(ROUNDS + 1):
        rows = run_lacking(rows, every, folder / f"round-{number}", workers)
        every = [*verdicts_of(rows)]
        every += between(verdicts_of(rows))
    return rows


def kept(folder: Path) -> pd.DataFrame:
    """Return the rows that are there already; delete the folder to run all of them again."""
    is_there = (folder / "situations.parquet").is_file()
    return read(folder, "situations") if is_there else table_of("situations").schema().empty_table().to_pandas()


def keep(rows: pd.DataFrame, folder: Path, drawn: int, seed: int) -> None:
    """Write rows with their provenance, and remove the runs that they came from."""
    keep_table("situations", folder / "situations.parquet", rows, drawn=drawn, seed=seed)
    for path in folder.glob("round-*"):
        shutil.rmtree(path)


def main() -> None:
    """Run the study."""
    words = make_parser("situations", __doc__, ("map", "held-out"), workers=2).parse_args()
    wanted = words.only or ["map"]
    if "map" in wanted:
        keep(make_map(words.workers, STUDY), STUDY, DRAWN, SEED)
    if "held-out" in wanted:
        folder = STUDY / "held-out"
        rows = run_lacking(kept(folder), draw(HELD_OUT, HELD_OUT_SEED, NAMES), folder / "round-0", words.workers)
        keep(rows, folder, HELD_OUT, HELD_OUT_SEED)


if __name__ == "__main__":
    main()
