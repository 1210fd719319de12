"""A plan: the units of one run, from a suite and what the user narrowed or widened it to."""

import dataclasses
import functools
import hashlib
import itertools
import json
from dataclasses import dataclass

import tasks
from bench.base.errors import Incompatible
from bench.base.provenance import source_digest
from bench.experiments.choice import EVERYTHING, IN_CONTACT, INTEGRATORS, WITHOUT, Choice, check_numbers, check_word
from bench.experiments.columns import Table
from bench.experiments.experiment import Asked, Experiment, Settings, Unit, known_experiments, known_tables
from bench.experiments.suites import suite
from bench.law.contender import Contender
from bench.law.inputs import PAPERS_GAINS, Gains
from tasks.rules import RULES


@dataclass(frozen=True)
class Plan:
    """Everything that decides the rows of a run."""

    settings: Settings
    units: tuple[Unit, ...]

    def of(self, *experiments: str) -> tuple[Unit, ...]:
        """Return the units of these experiments."""
        return tuple(unit for unit in self.units if unit.experiment in experiments)

    @property
    def tables(self) -> dict[str, Table]:
        """Return the tables of a run: all that suites have if one of them is run, and those of what no suite has."""
        own = [known_experiments()[name] for name in dict.fromkeys(unit.experiment for unit in self.units)]
        of_suites = known_tables() if any(one.in_suites for one in own) else {}
        return of_suites | {one.table.name: one.table for one in own if not one.in_suites}

    def episodes(self, *experiments: str) -> int:
        """Return how many episodes these experiments run; all of them if none is named."""
        return sum(unit.episodes for unit in (self.of(*experiments) if experiments else self.units))

    @property
    def contenders(self) -> tuple[Contender, ...]:
        """Return the laws and the controllers of arms that are run."""
        names = dict.fromkeys(unit.contender for unit in self.of("free-body", "arm", "robustness"))
        return tuple(map(self.settings.contender, names))

    def identity(self) -> dict:
        """Return what two runs must share for one to continue the other: the plan, the rules and the sources."""
        arms = dict.fromkeys(unit.arm for unit in self.units if unit.arm)
        return {
            **self.settings._asdict(),
            "own": {one.name: _digest(one.text) for one in self.settings.own},
            "units": [dataclasses.astuple(unit) for unit in self.units],
            "arms": {name: _digest(tasks.arm(name).xml) for name in arms},
            "rules": list(RULES),
            "sources": source_digest(),
        }

    @functools.cached_property
    def digest(self) -> str:
        """Sixteen hex digits of the identity."""
        return digest_of(self.identity())


def digest_of(identity: dict) -> str:
    """Return sixteen hex digits of an identity, as it is or as plan.json holds it."""
    return _digest(json.dumps(identity, sort_keys=True))


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def chosen(choice: Choice) -> list[Experiment]:
    """Return the experiments that are named, or else take every kind of word; Incompatible if none takes a word."""
    if not choice.experiments:
        return _taking(choice)
    found = [one for name, one in known_experiments().items() if name in choice.experiments]
    taken = {kind for one in found for kind in one.takes}
    for kind in choice.named:
        if kind not in taken:
            raise Incompatible(
                f"'{getattr(choice, kind)[0]}' cannot narrow the experiment '{found[0].name}', which takes "
                f"{', '.join(sorted(taken)).replace('_', ' ') or 'no other words'} (leave one of the two away)"
            )
    return found


def _taking(choice: Choice) -> list[Experiment]:
    """Return the experiments that take every kind of word named; Incompatible if two words exclude each other."""
    found = [one for one in known_experiments().values() if set(choice.named) <= set(one.takes)]
    taken = [set(one.takes) for one in known_experiments().values()]
    for pair in itertools.combinations(choice.named, 2):
        if not any(set(pair) <= kinds for kinds in taken):
            both = " and ".join(_shown(choice, kind) for kind in pair)
            raise Incompatible(f"nothing to run: no experiment takes both {both} (leave one of the two away)")
    if choice.tasks and set(choice.tasks) <= set(tasks.contact_names()):
        for kind in set(choice.named) - set(known_experiments()["contact"].takes):
            raise Incompatible(
                f"tasks in contact take an arm and a --controller, no {_shown(choice, kind)} (try: bench "
                "list controllers)"
            )
    return found


def _shown(choice: Choice, kind: str) -> str:
    return f"{kind.replace('_', ' ')} such as '{getattr(choice, kind)[0]}'"


def make(
    suite_word: str,
    laws: list[Contender],
    choice: Choice = EVERYTHING,
    *,
    count: int | None = None,
    dt_s: float = 1e-3,
    horizon_s: float | None = None,
    gains: Gains = PAPERS_GAINS,
    integrator: str | None = None,
    seed: int = 0,
) -> Plan:
    """Return the plan of a suite, as the user narrowed it; raise UnknownWord, BadNumber or Incompatible if it has none.

    Args:
        laws: the contenders of the free body; on arms the same laws, by the suite's Jacobians and inverses.
        count: of the starts of each set, and the poses of each task in contact; the suite's numbers if None.
        integrator: everywhere; IN_CONTACT in contact and WITHOUT elsewhere if None.
    """
    check_numbers(dt_s, horizon_s, gains, count, seed)
    if integrator is not None:
        check_word("integrator", integrator, list(INTEGRATORS))
    for word in choice.experiments:
        check_word("experiment", word, list(known_experiments()))
    asked = Asked(suite(suite_word), tuple(laws), choice.checked(), count, horizon_s, seed, gains)
    units = tuple(unit for one in chosen(asked.choice) for unit in one.units(asked))
    if not units:
        raise Incompatible("nothing to run: no unit of the experiments is left (name fewer words, or other ones)")
    without, in_contact = integrator or WITHOUT, integrator or IN_CONTACT
    return Plan(Settings(asked.suite.name, gains, dt_s, without, in_contact, seed, asked.own), units)
