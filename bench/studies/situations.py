"""Which law is the best in which situation? The map of `bench advise`: results/situations.

Situations drawn at random; planes of the damping ratio and each other number; then, for ROUNDS rounds, points halfway
between neighbours in a plane that get other advice. Two further sets decide nothing: the held-out one and the one in
between are drawn by the same rule and other seeds, and are run once. A situation is run for all laws together, because
laws are compared start by start; a new law needs a new map.

The seeds SEED, HELD_OUT_SEED and BETWEEN_SEED, and the rule of the draw, were committed before any of the three sets
was run. The sets before them had no law that knows the bound of its motor, and no bound below 0.05 kp; nothing of them
is kept.
"""

import itertools
import math
import shutil
from collections.abc import Iterable, Sequence
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.situations import mapped_laws, plan_of
from bench.experiments.tables.schema import table_of
from bench.experiments.tables.store import read, write_table
from bench.findings.selection.pairs import read_run
from bench.findings.selection.regions import NAMES, STUDY, RuleVerdict, decide, is_drawn, with_words
from bench.running import run
from bench.studies.study import keep_table, make_parser
from tasks.situation import COORDINATES, NOMINAL, Situation, read_situation, rounded

ROUNDS, DRAWN, SEED = 2, 300, 20261203
HELD_OUT, HELD_OUT_SEED = 60, 20261204
BETWEEN, BETWEEN_SEED = 100, 20261205
"""Numbers of drawn situations, and the seeds that they are drawn by."""

TOGETHER = 30
"""Situations of a run: a minute of two cores, which is lost at most if the study is stopped."""

DIFFERS = 0.35
"""Chance that a number of a drawn situation is not the nominal one; the damping ratio is always drawn."""

FINE = tuple(round(0.5 + 0.02 * k, 2) for k in range(36))
"""Damping ratios of the nominal line, along which each law is tuned."""


def planes() -> list[Situation]:
    """Return the situations of every plane of the damping ratio and one other number."""
    values = [{name: value} for name in NAMES[1:] for value in COORDINATES[name].levels]
    each = (NOMINAL._replace(zeta=zeta, **value) for value in values for zeta in COORDINATES["zeta"].levels)
    return list(dict.fromkeys((*each, *(NOMINAL._replace(zeta=zeta) for zeta in FINE))))


def draw(count: int, seed: int, names: Iterable[str] = NAMES) -> list[Situation]:
    """Draw situations: each number of `names` nominal or anywhere between its levels.

    At least two numbers beside the damping ratio are not the nominal ones.
    """
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


def between(verdicts: dict[Situation, RuleVerdict]) -> list[Situation]:
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


class Map(NamedTuple):
    """Rows of situations.parquet, and the comparisons of their laws, rows of pairs.parquet."""

    rows: pd.DataFrame
    pairs: pd.DataFrame

    def joined(self, rows: pd.DataFrame, pairs: pd.DataFrame) -> "Map":
        """Return this map with the rows and pairs of another run."""
        if self.rows.empty:
            return Map(rows, pairs)
        return Map(
            pd.concat([self.rows, rows], ignore_index=True),
            pd.concat([self.pairs, pairs], ignore_index=True),
        )

    def verdicts(self) -> dict[Situation, RuleVerdict]:
        """Return the rule's verdict on every situation."""
        pairs = dict(list(self.pairs.groupby("situation", observed=True)))
        none = self.pairs.iloc[:0]
        return {
            read_situation(str(word)): decide(rows, pairs=pairs.get(word, none))
            for word, rows in with_words(self.rows).groupby("situation", sort=False, observed=True)
        }


def run_lacking(known: Map, situations: Iterable[Situation], folder: Path, workers: int) -> Map:
    """Return a map with these situations, too: those that are not there are run with every law.

    A run that was stopped goes on, and a run that has ended is read again; `keep` removes them.
    """
    words = set(with_words(known.rows)["situation"]) if len(known.rows) else set()
    lacking = [situation for situation in situations if situation.word not in words]
    laws = mapped_laws()
    for number, first in enumerate(range(0, len(lacking), TOGETHER)):
        some = lacking[first : first + TOGETHER]
        out = folder.with_name(f"{folder.name}-{number:02d}")
        print(f"{folder.name}: situations {first} to {first + len(some)} of {len(lacking)}", flush=True)
        run.run(plan_of((law, situation) for law in laws for situation in some), out, workers=workers, replace=True)
        known = known.joined(*read_run(out))
    return known


def read_kept(folder: Path) -> Map:
    """Return the map that is there already; delete the folder to run all of it again."""
    if (folder / "pairs.parquet").is_file():
        return Map(read(folder, "situations"), read(folder, "pairs"))
    return Map(*(table_of(name).schema().empty_table().to_pandas() for name in ("situations", "pairs")))


def keep(found: Map, folder: Path, drawn: int, seed: int) -> None:
    """Write a map with its provenance, and remove the runs that it came from."""
    write_table(folder / "pairs.parquet", found.pairs, "pairs")
    keep_table("situations", folder / "situations.parquet", found.rows, drawn=drawn, seed=seed)
    for path in folder.glob("round-*"):
        shutil.rmtree(path)


def make_planes(known: Map, workers: int) -> Map:
    """Return the map with its planes, and with the rounds of halfway points."""
    known = run_lacking(known, planes(), STUDY / "round-planes", workers)
    for number in range(1, ROUNDS + 1):
        halfway = between(known.verdicts())
        known = run_lacking(known, halfway, STUDY / f"round-{number}", workers)
    return known


SETS = {
    "drawn": (STUDY, DRAWN, SEED),
    "held-out": (STUDY / "held-out", HELD_OUT, HELD_OUT_SEED),
    "between": (STUDY / "between", BETWEEN, BETWEEN_SEED),
}
"""Folder, number and seed of the situations that are drawn."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the study."""
    words = make_parser("situations", __doc__, (*SETS, "planes"), workers=2).parse_args(arguments)
    wanted = words.only or [*SETS, "planes"]
    for name, (folder, count, seed) in SETS.items():
        if name in wanted:
            found = run_lacking(read_kept(folder), draw(count, seed), folder / f"round-{name}", words.workers)
            keep(found, folder, count, seed)
    if "planes" in wanted:
        keep(make_planes(read_kept(STUDY), words.workers), STUDY, DRAWN, SEED)


if __name__ == "__main__":
    main()
