"""Advice in a situation of a user: closed forms first, then the laws that the map names, simulated there.

1. Near the goal every law is the same linear loop (`sampled_loop`). If it is unstable, or slower than the horizon, or
   if the bound is too small for any law to arrive within the horizon, no law is advised, and the limits are said.
2. The map names laws: what it advises in the nearest situation, what nothing beats in the NEIGHBOURS nearest ones,
   what it advises anywhere, and the fastest law that lacks what is required. Outside the map every law is tried.
3. They are simulated in the user's situation, all from the same starts. The map's law is advised if it has what is
   required and no other is faster by more than TIE, by a paired bootstrap over the starts; else the simplest of
   those that nothing beats so.
4. If none of them has what is required, all laws are simulated.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.request import Request
from bench.experiments.situations import (
    CROWD,
    HORIZON_S,
    count_typical,
    mapped_laws,
    run_half_turns,
    run_starts,
    summarize_drawn,
)
from bench.experiments.tables.statistics import quantile
from bench.findings.floor import find_floor
from bench.findings.selection.nearest import MapAnswer, Outside, answer, find_outside
from bench.findings.selection.pairs import compare_times, find_slower
from bench.findings.selection.regions import (
    RULE,
    STUDY,
    TIE,
    Rule,
    facts_of,
    find_regions,
    meets,
    read_map,
    with_words,
)
from bench.findings.theory.bang_bang import angle_of_share, least_time
from bench.findings.theory.sampled_loop import (
    SampledLoop,
    StabilityLimits,
    find_limits,
    settling_time,
    spectral_radius,
)
from bench.law.contender import Contender
from tasks.situation import KP, Situation

SEED = 2026
"""Seed of the draw of the starts."""

PAIR = ["law", "other", "log_ratio", "low", "high"]
"""What is read of a comparison of two laws."""

FIRST, MOST = 1024, 4096
"""Starts of every law that is tried; and of those among which one is advised."""

LEAST, SHORT = 4, 6
"""Laws that are tried, at least, and those of them that the map names, at most."""

HORIZON = HORIZON_S * math.sqrt(KP)
"""The end of an episode [1/sqrt(kp)]."""


class NearGoal(NamedTuple):
    """What closed forms say of a situation, in units of 1/sqrt(kp) and kp.

    radius: of the sampled loop near the goal; 1 and more is unstable. time: until the linear response stays in the
    band. limits: what would make an unstable loop stable. least: the time of the map's CROWD below which no law can be
    with this bound; 0 without one, with spin, or where goals jump.
    """

    radius: float
    time: float
    limits: StabilityLimits | None
    least: float

    @property
    def is_hopeless(self) -> bool:
        """Tell whether no law can settle within the horizon."""
        return self.radius >= 1.0 or max(self.time, self.least) > HORIZON


def loop_of(at: Situation) -> SampledLoop:
    """Return the linear loop of a situation, with kp = 1."""
    return SampledLoop(1.0, 2.0 * at.zeta, at.period, at.delay, at.inertia, at.unevenness)


def look_near_goal(at: Situation) -> NearGoal:
    """Return what closed forms say of a situation."""
    loop = loop_of(at)
    radius = spectral_radius(loop)
    limits = find_limits(loop) if radius >= 1.0 else None
    least = 0.0
    if math.isfinite(at.bound) and not at.spin and not at.jump:
        # The lightest axis turns the fastest; until the first command arrives nothing turns.
        least = at.delay + least_time(angle_of_share(CROWD), at.bound / min(loop.moments))
    return NearGoal(radius, settling_time(loop, HORIZON), limits, least)


def find_least_time(at: Situation, count: int, seed: int) -> float:
    """Return the time [1/sqrt(kp)] in which the fastest motions settle CROWD of a situation's starts.

    The fastest that the bound allows, of a body that is as inert about every axis, without delay and period: see
    `bench.findings.theory.time_optimal`, also for what is proved of it. NaN where that is not known: without a bound,
    where moments differ or the goal jumps, and where starts spin faster than those of the table.
    """
    if not math.isfinite(at.bound) or at.jump or at.unevenness:
        return math.nan
    starts = at.starts(count, seed)
    quats = np.array([start.quat_wxyz for start in starts])
    omegas = np.array([start.omega for start in starts])
    floor = find_floor(quats, omegas, at.bound * KP / at.inertia)
    if not floor.is_known.all():
        return math.nan
    return float(quantile(floor.times, CROWD)) * math.sqrt(KP)


class LawTrial(NamedTuple):
    """A law in a situation: the numbers of its drawn starts, as `situations.run_starts` gives them, and the counts.

    stuck, trapped: exact 180° rotations that do not settle, and those that do not under worst-case noise.
    """

    law: Contender
    at: Situation
    drawn: dict[str, np.ndarray]
    stuck: int
    trapped: int

    @property
    def times(self) -> np.ndarray:
        """Return the settling time of each drawn start [1/sqrt(kp)]; infinite where it does not settle."""
        return self.drawn["time"]

    @property
    def row(self) -> dict[str, Any]:
        """Return the row of situations.parquet that these starts make."""
        return {
            **self.law.words,
            **self.at._asdict(),
            **summarize_drawn(pd.DataFrame(self.drawn)),
            "stuck": self.stuck,
            "trapped": self.trapped,
            "operations": count_typical(self.law),
        }


class Trials:
    """Laws in one situation, each from as many of the same starts as were asked for.

    first, most: starts of every law that is tried, and of those among which one is advised.
    """

    def __init__(
        self,
        at: Situation,
        seed: int = SEED,
        report: Callable[[str], None] = lambda law: None,
        first: int = FIRST,
        most: int = MOST,
    ):
        self.at, self.report = at, report
        self.first, self.most = first, most
        self.request = Request("situations", seed=seed)
        self.by_law: dict[str, LawTrial] = {}
        self.known = {law.name: law for law in mapped_laws()}

    def run(self, law: str, count: int | None = None) -> LawTrial:
        """Return a law's trial of at least so many starts, `first` if None; those that ran before are kept."""
        count = count or self.first
        before = self.by_law.get(law)
        ran = len(before.times) if before else 0
        if before and ran >= count:
            return before
        self.report(law)
        contender = self.known[law]
        starts = self.at.starts(count, self.request.seed)[ran:]
        drawn = run_starts(self.request, contender, self.at, starts, self.at.condition())
        if before:
            drawn = {name: np.concatenate((before.drawn[name], numbers)) for name, numbers in drawn.items()}
            trial = before._replace(drawn=drawn)
        else:
            exact, noisy = run_half_turns(self.request, contender, self.at)
            stuck, trapped = (int((numbers["time"] == math.inf).sum()) for numbers in (exact, noisy))
            trial = LawTrial(contender, self.at, drawn, stuck, trapped)
        self.by_law[law] = trial
        return trial

    def rows(self) -> pd.DataFrame:
        """Return the rows of all laws that ran, with their words, the fastest first."""
        rows = with_words(pd.DataFrame([trial.row for trial in self.by_law.values()]))
        return rows.sort_values(["time", "operations"], ignore_index=True)

    def find_unbeaten(self, laws: Sequence[str], rule: Rule) -> list[str]:
        """Return the laws than which no other of them is faster, notably and not by the chance of these starts."""
        pairs = pd.DataFrame(compare_times({law: self.by_law[law].times for law in laws}), columns=PAIR)
        is_slower = find_slower(pairs, laws, rule.tie)
        return [law for place, law in enumerate(laws) if not is_slower[place].any()]


class Advice(NamedTuple):
    """What is advised in a situation.

    law: None if none is. near_goal: by closed forms. outside: numbers outside the map. nearest: the map's answer, None
    where it was not asked. rows: of each law that was simulated there, a row as in situations.parquet. qualified: laws
    that have what is required, published ones. ours: our own that have it. tied: qualified within TIE of the advised
    one, the fastest first. is_whole: every law was simulated. replaced: the map's law, where another is advised, and
    lacks: whether that is because it lacks what is required.
    least: the time of the fastest motions that the bound allows [1/sqrt(kp)], NaN where it is not known.
    """

    wanted: Situation
    law: str | None
    near_goal: NearGoal
    outside: tuple[Outside, ...] = ()
    nearest: MapAnswer | None = None
    rows: pd.DataFrame | None = None
    qualified: tuple[str, ...] = ()
    ours: tuple[str, ...] = ()
    tied: tuple[str, ...] = ()
    is_whole: bool = False
    replaced: str | None = None
    lacks: bool = False
    least: float = math.nan

    def row(self, law: str) -> dict[str, Any]:
        """Return the row of a law that was simulated."""
        assert self.rows is not None
        [found] = self.rows[self.rows["contender"] == law].to_dict("records")
        return {str(name): value for name, value in found.items()}


def may_be_advised(law: str) -> bool:
    """Tell whether a law is published or adapted from published work; a law of ours is compared, and not advised."""
    return not facts_of(law).is_ours


def advise(
    wanted: Situation,
    rule: Rule = RULE,
    is_whole: bool = False,
    seed: int = SEED,
    report: Callable[[str], None] = lambda law: None,
    folder: Path = STUDY,
    trials: Trials | None = None,
) -> Advice:
    """Advise a law; is_whole: simulate every law, whatever closed forms and the map say; trials: to be added to."""
    near_goal = look_near_goal(wanted)
    outside = find_outside(wanted)
    if near_goal.is_hopeless and not is_whole:
        return Advice(wanted, None, near_goal, outside)
    nearest = None if outside else answer(wanted, rule, folder)
    every = tuple(law.name for law in mapped_laws())
    laws = every if is_whole or nearest is None else shortlist(nearest, rule, folder)
    preferred = nearest.verdict.law if nearest else None
    trials = trials or Trials(wanted, seed, report)
    law = choose(trials, laws, rule, preferred)
    if law is None:
        law = choose(trials, every, rule, preferred)
    if near_goal.radius >= 1.0:
        # A loop may be so little unstable that episodes end before it shows.
        law = None
    rows = trials.rows()
    qualified = list_qualified(rows, rule)
    published = tuple(name for name in qualified if may_be_advised(name))
    advice = Advice(
        wanted,
        law,
        near_goal,
        outside,
        nearest,
        rows,
        qualified=published,
        ours=tuple(name for name in qualified if not may_be_advised(name)),
        is_whole=set(trials.by_law) == set(every),
        least=find_least_time(wanted, FIRST, trials.request.seed),
    )
    if law is None:
        return advice
    return advice._replace(
        tied=list_tied(rows, published, law),
        replaced=preferred if preferred != law else None,
        lacks=preferred not in published,
    )


def list_unmapped(folder: Path = STUDY) -> list[str]:
    """Return the laws that a map does not have yet, because they are newer than the study that made it."""
    mapped = set(read_map(folder)["contender"].astype(str))
    return [law.name for law in mapped_laws() if law.name not in mapped]


def shortlist(nearest: MapAnswer, rule: Rule, folder: Path = STUDY) -> tuple[str, ...]:
    """Return the laws that are tried: the map's, and the fastest other one that lacks what is required there.

    Where many numbers are far from those of the map at once, the nearest situations are not near, and a law that is
    advised elsewhere may be the best: the few that are advised anywhere are tried, too.
    """
    laws = list(nearest.laws[:SHORT])
    laws += [region.law for region in find_regions(folder, rule)]
    rows = nearest.rows.sort_values("time")
    lacking = rows["contender"][~meets(rows, rule)].astype(str)
    laws += [law for law in lacking if may_be_advised(law)][:1]
    # A few laws at least, so that what is said of all that were simulated is said of more than one or two.
    for law in rows["contender"].astype(str):
        if len(set(laws)) < LEAST and may_be_advised(law):
            laws.append(law)
    return tuple(dict.fromkeys(laws))


def choose(trials: Trials, laws: Sequence[str], rule: Rule, preferred: str | None) -> str | None:
    """Return the law that is advised of some; None if none of them has what is required.

    Those among which the choice is are run from the most starts. Of so many one may be lost: then it is made again.
    """
    for law in laws:
        trials.run(law)
    while True:
        qualified = [law for law in list_qualified(trials.rows(), rule) if may_be_advised(law)]
        if not qualified:
            return None
        unbeaten = trials.find_unbeaten(qualified, rule)
        candidates = [*unbeaten, preferred] if preferred in qualified else unbeaten
        short = [law for law in candidates if law and len(trials.by_law[law].times) < trials.most]
        if not short:
            break
        for law in short:
            trials.run(law, trials.most)
    if preferred in unbeaten:
        return preferred
    operations = trials.rows().set_index("contender")["operations"]
    return min(unbeaten, key=lambda law: (facts_of(law).memory, operations[law], law))


def list_qualified(rows: pd.DataFrame, rule: Rule) -> list[str]:
    """Return the laws of some rows that have what is required, in their order."""
    return rows["contender"][meets(rows, rule)].astype(str).tolist()


def list_tied(rows: pd.DataFrame, laws: Sequence[str], law: str) -> tuple[str, ...]:
    """Return the laws that are slower than a law by at most TIE, or faster."""
    times = rows.set_index("contender")["time"]
    longest = (1.0 + TIE) * times[law]
    return tuple(other for other in laws if other != law and times[other] <= longest)
