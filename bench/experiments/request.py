"""What a user asks for: a suite, laws and options; and whether an episode can be run with them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import tasks
from bench.base.errors import BadNumber, Incompatible, UnknownWord
from bench.experiments.suites import ENGINES, suite
from bench.law.contender import Contender
from bench.law.contenders.registry import contenders, find_contender
from bench.law.control.registry import find_controller
from bench.law.inputs import PAPERS_GAINS, Gains
from bench.law.kinds import Law
from tasks.rules import RULES, ticks

if TYPE_CHECKING:
    from bench.engines.episode import Settings as Limits

INTEGRATORS = ("euler", "implicit", "implicitfast", "rk4")
WITHOUT, IN_CONTACT = "euler", "implicitfast"
"""Integrators if none is named: the default of MuJoCo, and what it recommends for contacts."""

MOST_STARTS = 1_000_000
"""Largest number of starts of each set in one run."""

KINDS = (
    "tasks",
    "start_sets",
    "engines",
    "arms",
    "jacobians",
    "inverses",
    "variations",
    "controllers",
    "regulators",
    "representations",
    "axes",
)
"""The kinds of words that narrow the units of experiments: fields of a request."""

COMMON = ("suite", "gains", "dt_s", "integrator", "contact_integrator", "seed")
"""The fields of a request that rows depend on, beside the user's laws; the other fields show in the units."""


@dataclass(frozen=True)
class Request:
    """The suite, laws and options from which a plan is made, and the numbers that all its units have in common.

    No words, and None, stand for the suite's own.

    Attributes:
        suite: Name that the rows have. It is the name of a suite if a plan is made of it.
        laws: Contenders of the free body; on arms the same laws by the suite's Jacobians and inverses.
        gains: Gains of each unit that has none of its own.
        dt_s: Control period [s].
        integrator: Integrator of MuJoCo without contact.
        contact_integrator: Integrator of MuJoCo in contact.
        seed: Seed of all draws.
        count: Number of starts of each set or level, and of poses of each task in contact.
        horizon_s: Longest simulated time of each episode [s].
        tasks: With the ten fields below, the words that narrow the units (`KINDS`).
        experiments: The only experiments that are run.
    """

    suite: str = "experiment"
    laws: tuple[Contender, ...] = ()
    gains: Gains = PAPERS_GAINS
    dt_s: float = 1e-3
    integrator: str = WITHOUT
    contact_integrator: str = IN_CONTACT
    seed: int = 0
    count: int | None = None
    horizon_s: float | None = None
    tasks: tuple[str, ...] = ()
    start_sets: tuple[str, ...] = ()
    engines: tuple[str, ...] = ()
    arms: tuple[str, ...] = ()
    jacobians: tuple[str, ...] = ()
    inverses: tuple[str, ...] = ()
    variations: tuple[str, ...] = ()
    controllers: tuple[str, ...] = ()
    regulators: tuple[str, ...] = ()
    representations: tuple[str, ...] = ()
    axes: tuple[str, ...] = ()
    experiments: tuple[str, ...] = ()

    @property
    def user_laws(self) -> tuple[Law, ...]:
        """Return the user's laws, each once."""
        laws = (contender.regulator for contender in self.laws if contender.regulator.origin)
        return tuple(dict.fromkeys(laws))

    def contender(self, name: str) -> Contender:
        """Return the law, or the controller of an arm, of that name."""
        return find_contender(name, self.user_laws)

    def limits(self, horizon_s: float) -> Limits:
        """Return these numbers and the judge's rules as engines take them."""
        from bench.engines.episode import Settings as Limits

        return Limits(self.gains, self.dt_s, ticks(horizon_s, self.dt_s), RULES.hold_ticks(self.dt_s))

    def section(self, experiment: str) -> Mapping[str, Any]:
        """Return what the suite says of an experiment; UnknownWord if there is no suite of that name."""
        return suite(self.suite).sections[experiment]

    def common(self) -> dict[str, Any]:
        """Return the fields COMMON."""
        return {name: getattr(self, name) for name in COMMON}

    @property
    def named_kinds(self) -> tuple[str, ...]:
        """Return the kinds of words that are named."""
        return tuple(kind for kind in KINDS if getattr(self, kind))

    @property
    def names_laws(self) -> bool:
        """Tell whether it names laws, or coordinates that they act on."""
        return bool(self.regulators or self.representations)

    @property
    def is_about_contact(self) -> bool:
        """Tell whether it names a task in contact or a controller for one."""
        return bool(self.controllers or set(self.tasks) & set(tasks.contact_names()))

    @property
    def is_about_arms(self) -> bool:
        """Tell whether it names something that only arms have."""
        return bool(self.arms or self.jacobians or self.inverses or self.variations)

    @property
    def changes_starts_or_engines(self) -> bool:
        """Tell whether it names start sets or engines, which may be other ones than the suite's."""
        return bool(self.start_sets or self.engines)


def integrators(word: str | None) -> dict[str, Any]:
    """Return both integrators of a request: the named one, or the usual ones if none is named."""
    return {"integrator": word or WITHOUT, "contact_integrator": word or IN_CONTACT}


def checked(request: Request) -> Request:
    """Return a request with each word once.

    UnknownWord: a word is in no list. BadNumber: no episode can be run with a number. Incompatible: all tasks that are
    named have no arm, and something of an arm is named.
    """
    check_numbers(request.dt_s, request.horizon_s, request.gains, request.count, request.seed)
    for word in (request.integrator, request.contact_integrator):
        check_word("integrator", word, list(INTEGRATORS))
    suite(request.suite)
    words: dict[str, Any] = {kind: tuple(dict.fromkeys(getattr(request, kind))) for kind in (*KINDS, "experiments")}
    once = dataclasses.replace(request, **words)
    _check_words(once)
    bodies = [word for word in once.tasks if word in tasks.names() and not tasks.is_for_arms(word)]
    if bodies and once.is_about_arms and len(bodies) == len(once.tasks):
        raise Incompatible(
            f"task '{bodies[0]}' has no arm, so no Jacobian, inverse or variation (try: --task arm-regulation)"
        )
    return once


def _check_words(request: Request) -> None:
    """Refuse a word that is in no list of its kind."""
    sets = dict.fromkeys(tasks.start_set_names())
    if not sets.keys() >= set(request.start_sets):
        sets |= dict.fromkeys(tasks.start_set_names(arm=True))  # imports MuJoCo
    known: dict[str, tuple] = {
        "task": (request.tasks, sorted((*tasks.names(), *tasks.contact_names()))),
        "start": (request.start_sets, sets),
        "engine": (request.engines, ENGINES),
        "arm": (request.arms, tasks.arm_names()),
        "jacobian": (request.jacobians, contenders("jacobians")),
        "inverse": (request.inverses, contenders("inverses")),
        "variation": (request.variations, request.variations and tasks.variation_names()),
        "axis": (request.axes, request.axes and tasks.axis_names()),
    }
    for kind, (words, allowed) in known.items():
        for word in words:
            check_word(kind, word, list(allowed))
    for word in request.controllers:
        find_controller(word)


def check_word(kind: str, word: str, known: list[str]) -> None:
    """Refuse a word that is in no list."""
    if word not in known:
        raise UnknownWord(kind, word, sorted(known))


MOST_WORKERS = 256
"""Threads of a run: more than the cores of the machines that we know."""


def check_workers(workers: int) -> None:
    """Refuse a number of threads that cannot work."""
    if not 1 <= workers <= MOST_WORKERS:
        raise BadNumber(f"--workers {workers}: give between 1 and {MOST_WORKERS} threads (the number of cores is best)")


SHORTEST_DT_S, LONGEST_DT_S = 1e-6, 0.1
"""The default gains' time constant is 0.1 s; a microsecond makes ten million ticks of the shorter horizon."""


def check_numbers(dt_s: float, horizon_s: float | None, gains: Gains, count: int | None, seed: int) -> None:
    """Refuse numbers that no episode can be run with."""
    if not SHORTEST_DT_S <= dt_s <= LONGEST_DT_S:
        raise BadNumber(
            f"--dt {dt_s}: the control period must lie between {SHORTEST_DT_S} and {LONGEST_DT_S} s (try: --dt 0.001)"
        )
    if horizon_s is not None and not (math.isfinite(horizon_s) and dt_s <= horizon_s <= 1000.0):
        raise BadNumber(
            f"--horizon {horizon_s}: it must lie between one tick ({dt_s} s) and 1000 s (try: --horizon 10)"
        )
    for name, value in zip(("--kp", "--kv"), gains, strict=True):
        if not (math.isfinite(value) and 0.0 < value <= 1e6):
            raise BadNumber(f"{name} {value}: a gain must lie in (0, 1e6] (the paper's: --kp 100 --kv 20)")
    if count is not None and not 1 <= count <= MOST_STARTS:
        raise BadNumber(f"--count {count}: give between 1 and {MOST_STARTS} starts of each set")
    if not 0 <= seed < 2**32:
        raise BadNumber(f"--seed {seed}: give a whole number from 0 to 4294967295")
