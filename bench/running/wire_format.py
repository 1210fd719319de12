"""Some units of a plan as JSON: all that another process needs to know to make their rows.

Names and index ranges, the plan's numbers, and the text of a user's own laws; never an object. Whoever carries it out
must have the same sources, or its rows would be another run's.
"""

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path

from bench.base.errors import BadResults
from bench.base.provenance import source_digest
from bench.experiments.experiment import Unit
from bench.experiments.plan import Plan
from bench.experiments.request import Request
from bench.law.contender import Contender
from bench.law.contenders import described_law
from bench.law.contenders.law_file import keep_text
from bench.law.inputs import Gains
from bench.law.kinds import Law


def described(plan: Plan, units: Sequence[Unit]) -> dict:
    """Return the units and what they need of the plan as JSON; of the user's laws those that the units name."""
    named = {unit.law for unit in units}
    laws = [one.text for one in plan.request.user_laws if one.name in named]
    return {
        "sources": source_digest(),
        "request": {**plan.request.common(), "user_laws": laws},
        "units": [dataclasses.astuple(unit) for unit in units],
    }


def plan_of(content: dict, read: Callable[[Path, bytes], Law] = described_law.described) -> Plan:
    """Return a plan of these units alone; BadResults if other sources described it, BadLaw if a law fails to load.

    read: makes a law of a user's file; in a law's own process, and there alone, `law_file.load_law`.
    """
    if content["sources"] != source_digest():
        raise BadResults(
            f"the plan was made by the sources {content['sources']}, this process has {source_digest()}; install the "
            "same commit and lock on every machine"
        )
    words = dict(content["request"])
    laws = tuple(Contender(read(keep_text(text), text.encode())) for text in words.pop("user_laws"))
    request = Request(**words | {"gains": Gains(*words["gains"]), "laws": laws})
    return Plan(request, tuple(Unit(*fields) for fields in content["units"]))
