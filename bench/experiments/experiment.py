"""What an experiment is, and the units of work that it is made of.

An experiment is one file of this folder with a constant EXPERIMENT, and the TOML file of its table (`columns`): `units`
plans the work, `rows` does a unit of it in whatever process. The rows of all units, in their order, are the table.
CONTRIBUTING.md shows both files of an experiment.

Limitations: an experiment that imports a compiled engine, scipy or pandas outside its functions makes every plan, and
`list`, wait for it.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

from bench import experiments
from bench.base.errors import BadLaw
from bench.base.on_first_use import pd
from bench.experiments.columns import Table, read_table
from bench.experiments.request import Request
from bench.law.inputs import Gains
from tasks.discovery import constants


@dataclass(frozen=True)
class Unit:
    """A piece of work that is done or not done.

    Attributes:
        experiment: Name of its experiment.
        contender: Name of the law, the controller of an arm or the controller in contact.
        task: Name of the task.
        arm: Name of the arm.
        engine: Name of the engine.
        selector: Which starts: a start set, a perturbation, or "dense" of a task in contact.
        variation: Name of the plant's variation.
        first: The first of the starts, poses or axes that are meant.
        count: How many of them are meant.
        total: How many there are.
        episodes: Number of episodes that are run, in which progress is counted.
        horizon_s: Longest simulated time [s].
        kp: Position gain of its own [1/s^2]; 0 for the request's gains.
        kv: Velocity gain of its own [1/s].
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


OF_LAWS = ("tasks", "regulators", "representations")
"""What an experiment takes that runs some laws on the free body."""

OF_EPISODES = (*OF_LAWS, "start_sets", "engines")
ON_ARMS = (*OF_EPISODES, "arms", "jacobians", "inverses", "variations")


def no_rows(request: Request, unit: Unit, outcome: str = "") -> Rows:
    """Return no rows: this experiment has none for a law that crashed or hung."""
    return []


Rows: TypeAlias = "pd.DataFrame | list[dict] | dict[str, Any]"
"""Rows as a data frame, as one dict a row, or as columns."""


PARTS = ("units", "rows", "prepare", "lost", "is_whole", "fold")
"""Functions of an experiment's file that are parts of it by their names."""


@dataclass(frozen=True)
class Experiment:
    """The constant EXPERIMENT of a file: what there is to do, and what comes of it.

    Attributes:
        name: The file's name, with dashes.
        title: What it is, in a few words.
        table: Its columns and the key of a row (`columns.read_table`).
        units: units(request) -> its units in the order of the rows.
        rows: rows(request, unit) -> what `pandas.DataFrame` takes.
        cost_s: cost_s(unit) -> CPU seconds that it usually takes.
        takes: Kinds of words (`request.KINDS`) that narrow its units. Where another kind is named, it is not run.
        prepare: prepare(request, unit) compiles, imports and builds what its rows need, for all processes that are
            forked then.
        lost: lost(request, unit, outcome) -> what is left of a unit whose law crashed or hung.
        is_whole: is_whole(request, unit, rows) -> whether rows of a user's law can be all of the unit's, by their
            number and place.
        ticks: ticks(request, unit) -> upper bound of control periods, from which the time limit of a user's law
            follows; usually all of its episodes' to their horizon.
        is_divisible: Whether `Unit.part` of a unit is a unit too.
        is_tried_first: Whether a user's law goes through it before a run begins, so that a mistake leaves no folder.
        compiles: Whether its rows need compiled code.
        fold: fold(before, after) -> the rows of two units as those of both, where the table is not all of them in turn.
        in_suites: Whether suites have it.
        rank: Place among all, then by name.
    """

    name: str
    title: str
    table: Table
    units: Callable[[Request], tuple[Unit, ...]]
    rows: Callable[[Request, Unit], Rows]
    cost_s: Callable[[Unit], float]
    takes: tuple[str, ...] = ()
    prepare: Callable[[Request, Unit], None] = lambda request, unit: None
    lost: Callable[[Request, Unit, str], Rows] = no_rows
    is_whole: Callable[[Request, Unit, pd.DataFrame], bool] = lambda request, unit, rows: len(rows) > 0
    ticks: Callable[[Request, Unit], float] = lambda request, unit: unit.episodes * unit.horizon_s / request.dt_s
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


def rows_of(request: Request, unit: Unit) -> pd.DataFrame:
    """Return the rows of a unit."""
    own_gains = Gains(unit.kp, unit.kv) if unit.kp else request.gains
    at_gains = dataclasses.replace(request, gains=own_gains)
    return pd.DataFrame(experiment_of(unit).rows(at_gains, unit))


def user_laws_last(units: list[Unit], request: Request) -> tuple[Unit, ...]:
    """Return the units of our laws in their order, then those of a user's, contender by contender."""
    names = [law.name for law in request.user_laws]
    theirs = [unit.contender for unit in units if unit.law in names]
    place = {name: 1 + i for i, name in enumerate(dict.fromkeys(theirs))}
    return tuple(sorted(units, key=lambda unit: place.get(unit.contender, 0)))
