"""Every law of a run by the tests of C17 and C27, a row a law: what settles, how fast, by what way, at what cost."""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables.rows import number_rows, rows_where
from bench.experiments.tables.run import FREE_BODY, Run, converged, require_rows
from bench.experiments.tables.statistics import Estimate, quantile_estimate
from bench.findings.claims import places
from bench.findings.claims.once import once_a_run
from bench.findings.claims.places import EXACT_RAD
from bench.findings.claims.standing import (
    ORDERED,
    UNDECIDED,
    Ledger,
    Operations,
    Standing,
    price_of_a_call,
    times_of,
)
from bench.findings.claims.tables import settled, settling_times, starts_at_speed
from bench.findings.perturbed import DETOUR
from bench.findings.start_sets import least_starts
from bench.law.attribution import YOURS
from bench.law.contender import Contender
from bench.law.contenders.registry import all_contenders

if TYPE_CHECKING:
    from bench.findings.maps import Spun

CALLS = ("sin", "cos", "atan2", "acos")
DIRECTED = ("half-turn", "poles", "wraps", "box", "goals")

PAPERS = (
    "rotation-matrix",
    "linearized-euler/zyx-euler",
    "linearized-euler-literal/zyx-euler",
    "linearized-euler-relative/zyx-euler",
    "feedback-linearized/zyx-euler",
)
"""The paper's laws as contenders, with its reading of 2.4 and its equation to the letter; all others are later."""

THREE = ("rotation-matrix", "linearized-euler/zyx-euler", "feedback-linearized/zyx-euler")
"""The laws that it compares, in its order of cost: the first is 'remarkably simple', the others are 'more involved'."""

SETTLED_SHARE, NEARLY_ALL, SLOW = 0.999, 0.99, 2.0
LOST_SHARE = 1.0 - SETTLED_SHARE
DIRECTED_SHARE = 0.99
"""Share of the directed starts at rest, a few of which may be as near to a singular place as doubles can be."""

NOISE, HELD_RAD = "half-turn-noise", 0.1
"""Greatest worst-case noise near 180° that must not hold a law there: six degrees, which no sensor of
orientation in use exceeds by much, and far less than any law's memory could bridge."""


class Adequacy(NamedTuple):
    """One law: n uniform starts of which a share settles, the time in which nearly all do, directed starts that do not.

    lost_exact: directed starts that do not settle and are on a 180° rotation, a pole or a wrap themselves, of so many
    `exact`; lost: of others, the number directed. spun: random starts at stated speeds, with the run's gains; none of a
    law that no map has with them. detour: greatest path over the shortest, from uniform and half-turn starts; NaN if no
    row says it. rows: looked at.
    """

    name: str
    n: int
    settled: float
    pace: Estimate
    directed: int
    lost: int
    exact: int
    lost_exact: int
    spun: tuple[Spun, ...]
    detour: float
    cost: Operations
    rows: int


def every(run: Run, engine: str, laws: tuple[str, ...] = ()) -> list[Adequacy]:
    """Return the laws that have a suite's uniform starts, 180° rotations and a cost, the fewest operations first.

    laws: those that are looked at; all if none is named.
    """
    starts, operations = starts_of_laws(run, engine, laws), operations_of_laws(run)
    found = []
    for name in starts:
        start_sets = set(starts[name].start_set.tolist())
        if name in operations and {"uniform", "half-turn"} <= start_sets:
            spun = tuple(starts_at_speed(run, name, engine))
            found.append(measure(name, starts[name], operations[name], spun))
    return sorted(found, key=lambda law: sum(law.cost))


class Starts(NamedTuple):
    """Starts of one law, an element a start: the columns that its tests need.

    start_set: names. is_lost: whether it does not settle. is_exact: whether it is on a boundary. time [s]: of settling,
    infinite if it does not. path: over the shortest one.
    """

    start_set: np.ndarray
    is_lost: np.ndarray
    is_exact: np.ndarray
    time: np.ndarray
    path: np.ndarray

    def among(self, is_chosen: np.ndarray) -> Starts:
        """Return some of the starts."""
        return Starts(*(column[is_chosen] for column in self))


@once_a_run
def starts_of_laws(run: Run, engine: str, laws: tuple[str, ...]) -> dict[str, Starts]:
    """Return the converged starts that C17 and C27 are about, of each law that has as many as a claim needs."""
    runs = run.table("episodes", **FREE_BODY, task="free-body", engine=engine)
    is_chosen = runs["start_set"].isin(("uniform", *DIRECTED)).to_numpy()
    if laws:
        is_chosen = is_chosen & runs["contender"].isin(laws).to_numpy()
    runs = rows_where(runs, is_chosen)
    if run.has_folder:
        least = least_starts(engine, "beyond")
        lacking = find_lacking(runs, least, "uniform", "half-turn")
        runs = rows_where(runs, ~runs["contender"].isin(lacking).to_numpy())
    runs = require_rows(converged(runs), f"law with the starts that a claim needs by {engine}")
    starts = Starts(
        start_set=runs["start_set"].astype(object).to_numpy(),
        is_lost=~settled(runs).to_numpy(),
        is_exact=exact(runs).to_numpy(),
        time=settling_times(runs),
        path=runs["path_ratio"].to_numpy(float),
    )
    number, names = pd.factorize(runs["contender"], sort=True)
    return {str(name): starts.among(number == place) for place, name in enumerate(names)}


def find_lacking(runs: pd.DataFrame, least: Mapping[str, int], *start_sets: str) -> list[str]:
    """Return the laws with fewer starts of some set than they need."""
    first, _ = number_rows(runs, ("contender", "start_set", "start_id"))
    laws, sets = (runs[column].astype(object).to_numpy()[first].tolist() for column in ("contender", "start_set"))
    counts = Counter(zip(laws, sets, strict=True))
    found = []
    for law in dict.fromkeys(laws):
        if any(counts[law, name] < least.get(name, 0) for name in start_sets):
            found.append(law)
    return found


def measure(name: str, starts: Starts, operations: Stages, spun: tuple[Spun, ...]) -> Adequacy:
    """Return what is measured of a law that has uniform starts and 180° rotations."""
    is_uniform = starts.start_set == "uniform"
    uniform, directed = starts.among(is_uniform), starts.among(~is_uniform)
    plain = starts.among(is_uniform | (starts.start_set == "half-turn"))
    paths = plain.path[~np.isnan(plain.path)]
    return Adequacy(
        name,
        n=len(uniform.time),
        settled=float(1.0 - uniform.is_lost.mean()),
        pace=quantile_estimate(uniform.time, NEARLY_ALL),
        directed=int((~directed.is_exact).sum()),
        lost=int((directed.is_lost & ~directed.is_exact).sum()),
        exact=int(directed.is_exact.sum()),
        lost_exact=int((directed.is_lost & directed.is_exact).sum()),
        spun=spun,
        detour=float(paths.max()) if len(paths) else np.nan,
        cost=operations.total.without(operations.goal),
        rows=len(starts.time),
    )


def held(run: Run, noise_rad: float) -> dict[str, tuple[int, int]]:
    """Return by law the starts at 180° that worst-case noise up to an angle holds there, and of how many."""
    noise = run.table("robustness", axis=NOISE)
    tried = require_rows(noise[noise["level"] <= noise_rad], f"episode under '{NOISE}'")
    counts = tried.assign(lost=~settled(tried)).groupby("contender", observed=True)["lost"].agg(["sum", "size"])
    return {str(name): (int(lost), int(of)) for name, lost, of in counts.itertuples()}


def exact(runs: pd.DataFrame) -> pd.Series:
    """Tell whether a start is at 180°, a pole or a wrap to EXACT_RAD, or its goal on a pole."""
    distance = places.boundary_distance(runs)
    at_goal = distance["half_turn"].where(runs["angle0_rad"] > 1, np.pi)
    found = (distance["pole"] <= EXACT_RAD) | (distance["wrap"] <= EXACT_RAD) | (at_goal <= EXACT_RAD)
    return found | (places.goal_to_pole(runs) <= EXACT_RAD)


def of_stage(rows: pd.DataFrame, stage: str) -> Operations:
    """Flops and transcendental calls of one stage of a contender's rows."""
    place = (rows["stage"] == stage).to_numpy(bool).nonzero()[0][0]
    return Operations(int(rows["flops"].array[place]), sum(int(rows[name].array[place]) for name in CALLS))


def tallied(rows: pd.DataFrame, with_goal: bool) -> Operations:
    """Flops and transcendental calls of one contender's rows, a row a stage."""
    total = of_stage(rows, "total")
    return total if with_goal else total.without(of_stage(rows, "goal"))


class Stages(NamedTuple):
    """Operations of a law: of the whole tick, and of the goal's stage in it."""

    total: Operations
    goal: Operations


@once_a_run
def operations_of_laws(run: Run) -> dict[str, Stages]:
    """Return the operations of each law of the free body, typical branch, by its name in alphabetical order."""
    rows = run.table("costs", **FREE_BODY, branch="typical")
    laws, stages = (rows[column].astype(object).tolist() for column in ("contender", "stage"))
    calls = rows[list(CALLS)].to_numpy().sum(axis=1).tolist()
    found: dict[tuple[str, str], Operations] = {}
    for law, stage, *operations in zip(laws, stages, rows["flops"].tolist(), calls, strict=True):
        found.setdefault((law, stage), Operations(*operations))
    return {law: Stages(found[law, "total"], found[law, "goal"]) for law in sorted(set(laws))}


@once_a_run
def ledger(run: Run) -> Ledger:
    """Return the cost of laws of the free body, typical branch, without the goal's stage and with it."""
    by_law = operations_of_laws(run)
    alone = {name: stages.total.without(stages.goal) for name, stages in by_law.items()}
    whole = {name: stages.total for name, stages in by_law.items()}
    times = times_of(run.timings())
    return Ledger(times, (alone, whole), price_of_a_call(times, whole))


def of_three(run: Run) -> Ledger:
    """Return the ledger where the paper's three laws are counted; NoEvidence: one of them is not."""
    known = ledger(run)
    for name in THREE:
        require_rows([one[name] for one in known.accountings if name in one], f"cost of {name}")
    return known


TESTS = "abcdefgh"
"""Tests of C27's criterion, in its order."""

TEST_NAMES = {
    "a": "uniform starts",
    "b": "difficult or spinning starts",
    "c": "settling time",
    "d": "cost by measured time",
    "e": "starts exactly on a boundary",
    "f": "noise at 180°",
    "g": "length of the path",
    "h": "cost by counted operations",
}

BOTH = "abcd"
"""What C17 asks."""


PASSES = "passes"


class Tested(NamedTuple):
    """The tests of C27's criterion that a law does not pass, and those that were not run on it.

    What was not tested is neither passed nor failed.
    """

    failed: frozenset[str]
    untested: frozenset[str]

    def among(self, tests: str) -> Tested:
        """Return what these tests alone say."""
        return Tested(self.failed & set(tests), self.untested & set(tests))

    @property
    def passes(self) -> bool:
        """Whether every test was run and passed."""
        return not self.failed and not self.untested

    @property
    def may_pass(self) -> bool:
        """Whether no test was failed, and one was not run."""
        return not self.failed and bool(self.untested)

    def __str__(self) -> str:
        parts = [f"fails {', '.join(sorted(self.failed))}"] if self.failed else []
        parts += [f"not tested: {', '.join(sorted(self.untested))}"] if self.untested else []
        return "; ".join(parts) or PASSES

    def in_words(self) -> str:
        """Return the same with the name of each test: 'fails (c) settling time'."""
        parts = [f"fails {_named(self.failed)}"] if self.failed else []
        parts += [f"not tested: {_named(self.untested)}"] if self.untested else []
        return "; ".join(parts) or PASSES


def _named(tests: Iterable[str]) -> str:
    return ", ".join(f"({test}) {TEST_NAMES[test]}" for test in sorted(tests))


def examine(
    law: Adequacy,
    known: Ledger,
    small_s: float,
    held: dict[str, tuple[int, int]],
    on_angles: tuple[str, ...] = THREE[1:],
) -> Tested:
    """Return how a law does in the tests of C27's criterion.

    held: starts at 180° that noise holds there, by law; a law that is not among them was not tried under noise.
    on_angles: the laws than which it must cost less.
    """
    costs = [known.stand(law.name, other) for other in on_angles if other != law.name]
    results = {
        "a": law.settled >= SETTLED_SHARE,
        "b": _settles_directed_and_spun(law),
        "c": law.pace.high <= SLOW * small_s,
        "d": all_pass(_is_cheaper(stands.sign, stands) for stands in costs),
        "e": not law.lost_exact if law.exact else None,
        "f": held[law.name][0] == 0 if law.name in held else None,
        "g": law.detour < DETOUR if np.isfinite(law.detour) else None,
        "h": all_pass(_is_cheaper(stands.by_operations, stands) for stands in costs),
    }
    failed = frozenset(test for test, result in results.items() if result is not None and not result)
    untested = frozenset(test for test, result in results.items() if result is None)
    return Tested(failed, untested)


def all_pass(results: Iterable[bool | None]) -> bool | None:
    """Return whether all of some results are passes: one failure decides; else None if one is None or none is there."""
    every = list(results)
    if any(result is not None and not result for result in every):
        return False
    return None if not every or None in every else True


def _settles_directed_and_spun(law: Adequacy) -> bool | None:
    """Whether the directed starts that are on no boundary settle, and the random starts at every stated speed."""
    settles_directed = law.lost <= (1.0 - DIRECTED_SHARE) * law.directed if law.directed else None
    spinning = [spun for spun in law.spun if spun.speed > 0.0]
    settles_spun = all_pass(spun.share.high <= LOST_SHARE for spun in spinning)
    return all_pass((settles_directed, settles_spun))


def _is_cheaper(sign: int, stands: Standing) -> bool | None:
    """Whether a law is the cheaper one of a pair; None where nothing that is known of their cost decides."""
    return None if sign == UNDECIDED and not stands.is_known else sign == ORDERED


@functools.cache
def _known() -> dict[str, Contender]:
    """Return every contender of this repository by name."""
    return {contender.name: contender for contender in all_contenders()}


def whose(name: str) -> str:
    """Return whether a contender's law is published, adapted here from others' works, ours, or a user's own."""
    return _known()[name].attribution if name in _known() else YOURS


def is_without_memory(name: str) -> bool:
    """Tell whether a law of this repository keeps nothing from one control period to the next."""
    return name in _known() and not _known()[name].regulator.memory
