"""What a user names of a plan, and whether it can be: words that exist, numbers that an episode can be run with."""

import math
from dataclasses import dataclass

import tasks
from bench.base.errors import BadNumber, Incompatible, UnknownWord
from bench.experiments.suites import ENGINES
from bench.law.contenders.registry import contenders
from bench.law.control.registry import find_controller
from bench.law.inputs import Gains

INTEGRATORS = ("euler", "implicit", "implicitfast", "rk4")
WITHOUT, IN_CONTACT = "euler", "implicitfast"
"""Integrators if none is named: the default of MuJoCo, and what it recommends for contacts."""

MOST_STARTS = 1_000_000
"""Largest number of starts of each set in one run."""


@dataclass(frozen=True)
class Choice:
    """What the user named, beside the laws; empty means the suite's own."""

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

    def checked(self) -> "Choice":
        """Return each word once; UnknownWord for one in no list, Incompatible for a task without an arm on one."""
        once = Choice(**{name: tuple(dict.fromkeys(words)) for name, words in vars(self).items()})
        sets = dict.fromkeys(tasks.start_set_names())
        if not sets.keys() >= set(once.start_sets):
            sets |= dict.fromkeys(tasks.start_set_names(arm=True))  # imports MuJoCo
        known: dict[str, tuple] = {
            "task": (once.tasks, sorted((*tasks.names(), *tasks.contact_names()))),
            "start": (once.start_sets, sets),
            "engine": (once.engines, ENGINES),
            "arm": (once.arms, tasks.arm_names()),
            "jacobian": (once.jacobians, contenders("jacobians")),
            "inverse": (once.inverses, contenders("inverses")),
            "variation": (once.variations, once.variations and tasks.variation_names()),
            "axis": (once.axes, once.axes and tasks.axis_names()),
        }
        for kind, (words, allowed) in known.items():
            for word in words:
                check_word(kind, word, list(allowed))
        for word in once.controllers:
            find_controller(word)
        bodies = [word for word in once.tasks if word in tasks.names() and not tasks.is_for_arms(word)]
        if bodies and once.is_about_arms and len(bodies) == len(once.tasks):
            raise Incompatible(
                f"task '{bodies[0]}' has no arm, so no Jacobian, inverse or variation (try: --task arm-regulation)"
            )
        return once

    @property
    def named(self) -> tuple[str, ...]:
        """Return the kinds of words that are named, experiments apart."""
        return tuple(kind for kind, words in vars(self).items() if words and kind != "experiments")

    @property
    def is_of_some_laws(self) -> bool:
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
    def narrows(self) -> bool:
        """Tell whether start sets or engines other than the suite's are chosen."""
        return bool(self.start_sets or self.engines)


EVERYTHING = Choice()
"""Nothing named: the suite as it is."""


def check_word(kind: str, word: str, known: list[str]) -> None:
    """Refuse a word that is in no list."""
    if word not in known:
        raise UnknownWord(kind, word, sorted(known))


MOST_WORKERS = 256
"""Threads of a run: more than the cores of the machines that we know."""


def check_workers(workers: int) -> None:
    """Refuse a number of threads that cannot work."""
    if not 1 <= workers <= MOST_WORKERS:
        raise BadNumber(
            f"--workers {workers}: give between 1 and {MOST_WORKERS} threads (the number of cores is best)"
        )


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
