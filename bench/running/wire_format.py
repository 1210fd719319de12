"""Some units of a plan as JSON: all that another process needs to know to make their rows.

Names and index ranges, the plan's numbers, and the text of a user's own laws; never an object. Whoever carries it out
must have the same sources, or its rows would be another run's.
"""

import dataclasses
import functools
import hashlib
import tempfile
from collections.abc import Sequence
from pathlib import Path

from bench.contenders.law_file import load_law
from bench.contenders.registry import find_contender
from bench.errors import BadResults
from bench.experiments.contact_plan import ContactUnit
from bench.experiments.plan import AnyUnit, Plan, Unit
from bench.experiments.robustness_plan import RobustnessUnit
from bench.law.contender import Gains, Regulator
from bench.provenance import source_digest

KINDS = {kind.table: kind for kind in (Unit, ContactUnit, RobustnessUnit)}
NUMBERS = (
    *("suite", "dt_s", "integrator", "contact_integrator", "seed"),
    *("traces", "boundary_axes", "arm_traces"),
)
"""Fields of a plan that rows, curves and boundaries depend on, beside the gains."""


def described(plan: Plan, units: Sequence[AnyUnit]) -> dict:
    """The chunk as JSON takes it."""
    named = {unit.contender for unit in units}
    own = dict.fromkeys(one.regulator.origin for one in plan.contenders if one.name in named and one.regulator.origin)
    return {
        "sources": source_digest(),
        "gains": list(plan.gains),
        **{name: getattr(plan, name) for name in NUMBERS},
        "laws": [Path(path).read_text(encoding="utf-8") for path in own],
        "units": [[unit.table, dataclasses.asdict(unit)] for unit in units],
    }


def plan_of(chunk: dict) -> Plan:
    """A plan of the chunk's units alone.

    Errors:
        BadResults: it was described by other sources. BadLaw: a user's law that this process cannot load.
    """
    if chunk["sources"] != source_digest():
        raise BadResults(
            f"the plan was made by the sources {chunk['sources']}, this process has {source_digest()}; install the "
            "same commit and lock on every machine"
        )
    own = tuple(map(_law, chunk["laws"]))
    units = [KINDS[table](**fields) for table, fields in chunk["units"]]
    contacts = tuple(unit for unit in units if isinstance(unit, ContactUnit))
    names = dict.fromkeys(unit.contender for unit in units if unit not in contacts)
    return Plan(
        units=tuple(unit for unit in units if isinstance(unit, Unit)),
        contacts=contacts,
        troubles=tuple(unit for unit in units if isinstance(unit, RobustnessUnit)),
        contenders=tuple(find_contender(name, own) for name in names),
        gains=Gains(*chunk["gains"]),
        **{name: chunk[name] for name in NUMBERS},
    )


@functools.lru_cache(maxsize=32)
def _law(text: str) -> Regulator:
    """A user's law from its text, which lies in a file of its own as long as this process lives.

    Once for all chunks, so that it is compiled once.
    """
    digest = hashlib.sha256(text.encode()).hexdigest()[:16]
    path = Path(_folder().name) / f"law_{digest}.py"
    path.write_text(text, encoding="utf-8")
    return load_law(path)


@functools.cache
def _folder() -> tempfile.TemporaryDirectory:
    return tempfile.TemporaryDirectory(prefix="orientation-bench-laws-")
