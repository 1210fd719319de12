"""What an experiment is, and the units of work that it is made of.

An experiment is one file of this folder with a constant EXPERIMENT, and the TOML file of its table (`columns`): `units`
plans the work, `rows` does a unit of it in whatever process. The rows of all units, in their order, are the table.

Limitations: an experiment that imports a compiled engine, scipy or pandas outside its functions makes every plan, and
`list`, wait for it.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from bench import experiments
from bench.base.errors import BadLaw
from bench.base.on_first_use import pd
from bench.experiments.choice import IN_CONTACT, WITHOUT, Choice
from bench.experiments.columns import Table, read_table
from bench.experiments.suites import Suite
from bench.law.contender import Contender
from bench.law.contenders.registry import find_contender
from bench.law.inputs import PAPERS_GAINS, Gains
from bench.law.kinds import Law
from tasks.discovery import constants
from tasks.rules import RULES, ticks

if TYPE_CHECKING:
    from bench.engines.episode import Settings as Limits


class Settings(NamedTuple):
    """What all units of a run share; own: the user's laws; suite: what the rows say that they belong to."""

    suite: str = "experiment"
    gains: Gains = PAPERS_GAINS
    dt_s: float = 1e-3
    integrator: str = WITHOUT
    contact_integrator: str = IN_CONTACT
    seed: int = 0
    own: tuple[Law, ...] = ()

    def contender(self, name: str) -> Contender:
        """Return the law, or the controller of an arm, of that name."""
        return find_contender(name, self.own)

    def limits(self, horizon_s: float) -> Limits:
        """Return these numbers and the judge's rules as engines take them."""
        from bench.engines.episode import Settings as Limits

        return Limits(self.gains, self.dt_s, ticks(horizon_s, self.dt_s), RULES.hold_ticks(self.dt_s))


@dataclass(frozen=True)
class Unit:
    """A piece of work that is done or not done.

    selector: which starts: a start set, a perturbation, or "dense" of a task in contact. first, count: the stretch of
    them that is meant, in starts, poses or axes; total: of so many. episodes: how many are run, of those that progress
    is counted in. kp, kv: gains of its own; 0: those of the settings.
    """

    experiment: str
    contender: str = ""
    task: str = ""
    arm: str = ""
    engine: str = ""
    selector: str = ""
    variation: str = ""
    first: int = 0
    count: int = 0
    total: int = 0
    episodes: int = 0
    horizon_s: float = 0.0
    kp: float = 0.0
    kv: float = 0.0

    @property
    def key(self) -> str:
        """Return a name for a file."""
        law = self.contender.replace("/", "~")
        words = (self.experiment, self.engine, law, self.task, self.arm, self.variation, self.selector)
        gains = f"kp{self.kp:g}-{self.kv:g}" if self.kp else ""
        return "_".join((*filter(None, (*words, gains)), f"{self.first:06d}"))

    @property
    def law(self) -> str:
        """Return the name of the contender's regulator."""
        return self.contender.partition("@")[0].partition("/")[0]

    @property
    def label(self) -> str:
        """Return where it is and what it runs, in a few words."""
        where = (self.arm or self.engine or self.selector) if self.episodes else self.experiment
        return f"{where} {self.contender.split('/')[0] or self.arm}"

    def part(self, first: int, count: int) -> Unit:
        """Return a unit of some of its starts, an episode each."""
        return dataclasses.replace(self, first=first, count=count, episodes=count)

    def cut(self, count: int, most: int) -> Iterator[Unit]:
        """Yield units of so many starts together, of at most so many each."""
        return (self.part(first, min(most, count - first)) for first in range(0, count, most))


@dataclass(frozen=True)
class Asked:
    """What a plan is made of: a suite, laws of the free body, and what the user asked for; None is the suite's own.

    count: of the starts of each set or level, and the poses of each task in contact. horizon_s: of every episode.
    """

    suite: Suite
    laws: tuple[Contender, ...]
    choice: Choice
    count: int | None = None
    horizon_s: float | None = None
    seed: int = 0
    gains: Gains = PAPERS_GAINS

    @property
    def own(self) -> tuple[Law, ...]:
        """Return the user's laws."""
        return tuple(dict.fromkeys(one.regulator for one in self.laws if one.regulator.origin))


OF_LAWS = ("tasks", "regulators", "representations")
"""What an experiment takes that runs some laws on the free body."""

OF_EPISODES = (*OF_LAWS, "start_sets", "engines")
ON_ARMS = (*OF_EPISODES, "arms", "jacobians", "inverses", "variations")


def no_rows(settings: Settings, unit: Unit, outcome: str = "") -> Rows:
    """Return no rows: this experiment has none for a law that crashed or hung."""
    return []


Rows: TypeAlias = "pd.DataFrame | list[dict] | dict[str, Any]"
"""Rows as a data frame, as one dict a row, or as columns."""


PARTS = ("units", "rows", "prepare", "lost", "is_whole", "fold")
"""Functions of an experiment's file that are parts of it by their names."""


class Experiment(NamedTuple):
    """The constant EXPERIMENT of a file: what there is to do, and what comes of it.

    name: the file's, with dashes. table: its columns and the key of a row (`columns.read_table`). units(asked): in the
    order of the rows. rows(settings, unit) -> what `pandas.DataFrame` takes. cost_s(unit) -> seconds it usually takes.
    prepare(settings, unit): compile, import and build what its rows need, for all processes that are forked then.
    lost(settings, unit, outcome) -> what is left of a unit whose law crashed or hung. is_whole(settings, unit, rows):
    whether rows of a user's law can be all of the unit's, by their number and place. ticks(settings, unit) -> control
    periods at most, which a user's law has its time by; usually all of its episodes' to their horizon.
    is_divisible: whether `Unit.part` of it is a unit too. is_tried_first: whether a user's law goes through it before a
    run begins, so that a mistake leaves no folder. takes: the kinds of words, fields of Choice, that narrow its units;
    where another kind is named, it is not run. fold(before, after) -> the rows of two units as those of both, where the
    table is not all of them in turn. in_suites: whether suites have it. rank: place among all, then by name.
    """

    name: str
    title: str
    table: Table
    units: Callable[[Asked], tuple[Unit, ...]]
    rows: Callable[[Settings, Unit], Rows]
    cost_s: Callable[[Unit], float]
    takes: tuple[str, ...] = ()
    prepare: Callable[[Settings, Unit], None] = lambda settings, unit: None
    lost: Callable[[Settings, Unit, str], Rows] = no_rows
    is_whole: Callable[[Settings, Unit, pd.DataFrame], bool] = lambda settings, unit, rows: len(rows) > 0
    ticks: Callable[[Settings, Unit], float] = lambda settings, unit: unit.episodes * unit.horizon_s / settings.dt_s
    is_divisible: bool = False
    is_tried_first: bool = False
    compiles: bool = True
    fold: Callable[[pd.DataFrame, pd.DataFrame], pd.DataFrame] | None = None
    in_suites: bool = True
    rank: int = 9

    @classmethod
    def of(cls, module: dict[str, Any], title: str, table: Table | None = None, **more: Any) -> Experiment:
        """Return the experiment of a file, whose globals have PARTS; table: its TOML file's if None."""
        name = module["__name__"].rpartition(".")[2].replace("_", "-")
        parts = {part: module[part] for part in PARTS if part in module}
        return cls(name, title, table or read_table(module["__file__"], name), **parts | more)


@functools.cache
def known_experiments() -> dict[str, Experiment]:
    """Return word -> Experiment, in the order of plans; BadLaw for one that is none, or named unlike its file."""
    found = constants(experiments, "EXPERIMENT")
    for word, one in found.items():
        if not isinstance(one, Experiment) or one.name != word:
            raise BadLaw(
                f"bench/experiments/{word.replace('-', '_')}.py: EXPERIMENT must be an Experiment named '{word}'"
            )
    return dict(sorted(found.items(), key=lambda item: item[1].rank))


def known_tables() -> dict[str, Table]:
    """Word -> Table of every experiment that suites have."""
    return {one.table.name: one.table for one in known_experiments().values() if one.in_suites}


def experiment_of(unit: Unit) -> Experiment:
    """Return the experiment that a unit is of."""
    return known_experiments()[unit.experiment]


def rows_of(settings: Settings, unit: Unit) -> pd.DataFrame:
    """Return the rows of a unit."""
    gains = Gains(unit.kp, unit.kv) if unit.kp else settings.gains
    return pd.DataFrame(experiment_of(unit).rows(settings._replace(gains=gains), unit))


def own_last(units: list[Unit], own: tuple[Law, ...]) -> tuple[Unit, ...]:
    """Return the units of our laws in their order, then those of a user's, contender by contender."""
    names = [one.name for one in own]
    theirs = [unit.contender for unit in units if unit.law in names]
    place = {name: 1 + i for i, name in enumerate(dict.fromkeys(theirs))}
    return tuple(sorted(units, key=lambda unit: place.get(unit.contender, 0)))
