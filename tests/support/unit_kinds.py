"""A small plan with units of every experiment, some of a user's law."""

import dataclasses
from pathlib import Path

from bench.experiments import plan, situations
from bench.experiments.choice import EVERYTHING, Choice
from bench.experiments.experiment import Asked, Unit, known_experiments
from bench.experiments.map import plan_of
from bench.experiments.suites import suite
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import find_contender
from support.user_law import DAMPER, law_text
from tasks.situation import NOMINAL


def plan_of_all_kinds(folder: Path) -> plan.Plan:
    """Units of every experiment; some of a user's law, whose file is in the folder."""
    path = folder / "mine.py"
    path.write_text(law_text(DAMPER))
    ours = find_contender("rotation-matrix")
    laws, short = [ours, find_contender("mine", (load_law(path),))], {"count": 2, "horizon_s": 0.05}
    choices = (
        Choice(start_sets=("paper",), engines=("ideal-rk4",), experiments=("free-body",)),
        Choice(("arm-regulation",), ("clear",), ("native",), ("ur5e",), ("geometric",), ("solve",)),
        Choice(("wrench-probe",), arms=("ur5e",), controllers=("hybrid-base+inverse",), experiments=("contact",)),
        Choice(axes=("delay",), experiments=("robustness",)),
    )
    alone, *others = [plan.make("quick", laws if k == 0 else [ours], one, **short) for k, one in enumerate(choices)]
    on_arm, contact, perturbed = (one.units for one in others)
    made = (
        Unit("springs", count=1, total=1),
        Unit("costs", "rotation-matrix"),
        Unit("costs", "mine"),
        *plan_of([ours], 200, speeds=((0.0, 20.0),), horizon_s=1.0).units,
        *situations.plan_of([(ours, NOMINAL)]).units,
    )
    runs = (*alone.units, *(unit for unit in on_arm if unit.experiment == "arm"), *contact[:1], *perturbed)
    kinds, asked = {unit.experiment for unit in (*runs, *made)}, Asked(suite("quick"), (ours,), EVERYTHING, **short)
    others = [one.units(asked)[0] for name, one in known_experiments().items() if name not in kinds]
    return dataclasses.replace(alone, units=(*runs, *made, *others))
