"""A plan: the units of one run, from a request."""

import dataclasses
import functools
import hashlib
import itertools
import json
from dataclasses import dataclass

import tasks
from bench.base.errors import Incompatible
from bench.base.provenance import source_digest
from bench.experiments.columns import Table
from bench.experiments.experiment import Experiment, Unit, known_experiments, known_tables
from bench.experiments.request import Request, check_word, checked
from bench.law.contender import Contender
from tasks.rules import RULES


@dataclass(frozen=True)
class Plan:
    """Everything that decides the rows of a run.

    Attributes:
        request: The numbers that all units have in common, and the user's laws.
        units: The units in the order of their rows.
    """

    request: Request
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
        return tuple(map(self.request.contender, names))

    def identity(self) -> dict:
        """Return what two runs must share for one to continue the other: the plan, the rules and the sources."""
        arms = dict.fromkeys(unit.arm for unit in self.units if unit.arm)
        return {
            **self.request.common(),
            "own": {law.name: _digest(law.text) for law in self.request.user_laws},
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


def chosen(request: Request) -> list[Experiment]:
    """Return the experiments that are named, or else take every kind of word; Incompatible if none takes a word."""
    if not request.experiments:
        return _taking(request)
    found = [one for name, one in known_experiments().items() if name in request.experiments]
    taken = {kind for one in found for kind in one.takes}
    for kind in request.named_kinds:
        if kind not in taken:
            raise Incompatible(
                f"'{getattr(request, kind)[0]}' cannot narrow the experiment '{found[0].name}', which takes "
                f"{', '.join(sorted(taken)).replace('_', ' ') or 'no other words'} (leave one of the two away)"
            )
    return found


def _taking(request: Request) -> list[Experiment]:
    """Return the experiments that take every kind of word named; Incompatible if two words exclude each other."""
    kinds = request.named_kinds
    found = [one for one in known_experiments().values() if set(kinds) <= set(one.takes)]
    taken = [set(one.takes) for one in known_experiments().values()]
    for pair in itertools.combinations(kinds, 2):
        if not any(set(pair) <= takes for takes in taken):
            both = " and ".join(_shown(request, kind) for kind in pair)
            raise Incompatible(f"nothing to run: no experiment takes both {both} (leave one of the two away)")
    if request.tasks and set(request.tasks) <= set(tasks.contact_names()):
        for kind in set(kinds) - set(known_experiments()["contact"].takes):
            raise Incompatible(
                f"tasks in contact take an arm and a --controller, no {_shown(request, kind)} (try: bench "
                "list controllers)"
            )
    return found


def _shown(request: Request, kind: str) -> str:
    return f"{kind.replace('_', ' ')} such as '{getattr(request, kind)[0]}'"


def make(request: Request) -> Plan:
    """Return the plan of a request; raise UnknownWord, BadNumber or Incompatible if it has none."""
    request = checked(request)
    for word in request.experiments:
        check_word("experiment", word, list(known_experiments()))
    units: list[Unit] = []
    for experiment in chosen(request):
        units += experiment.units(request)
    if not units:
        raise Incompatible("nothing to run: no unit of the experiments is left (name fewer words, or other ones)")
    return Plan(request, tuple(units))
