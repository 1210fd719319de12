"""A small plan with units of every experiment, some of a user's law."""

import dataclasses
from pathlib import Path

from bench.experiments import plan, situations
from bench.experiments.experiment import Unit, known_experiments
from bench.experiments.map import plan_of
from bench.experiments.request import Request
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import find_contender
from support.user_law import DAMPER, law_text
from tasks.situation import NOMINAL


def plan_of_all_kinds(folder: Path) -> plan.Plan:
    """Units of every experiment; some of a user's law, whose file is in the folder."""
    path = folder / "mine.py"
    path.write_text(law_text(DAMPER))
    ours, own = find_contender("rotation-matrix"), find_contender("mine", (load_law(path),))
    short = Request("quick", (ours,), count=2, horizon_s=0.05)
    alone = plan.make(
        dataclasses.replace(
            short,
            laws=(ours, own),
            start_sets=("paper",),
            engines=("ideal-rk4",),
            experiments=("free-body",),
        )
    )
    on_arm = plan.make(
        dataclasses.replace(
            short,
            tasks=("arm-regulation",),
            start_sets=("clear",),
            engines=("native",),
            arms=("ur5e",),
            jacobians=("geometric",),
            inverses=("solve",),
        )
    )
    contact = plan.make(
        dataclasses.replace(
            short,
            tasks=("wrench-probe",),
            arms=("ur5e",),
            controllers=("hybrid-base+inverse",),
            experiments=("contact",),
        )
    )
    perturbed = plan.make(dataclasses.replace(short, axes=("delay",), experiments=("robustness",)))
    units = (
        *alone.units,
        *on_arm.of("arm"),
        *contact.units[:1],
        *perturbed.units,
        Unit("springs", count=1, total=1),
        Unit("costs", "rotation-matrix"),
        Unit("costs", "mine"),
        *plan_of([ours], 200, speeds=((0.0, 20.0),), horizon_s=1.0).units,
        *situations.plan_of([(ours, NOMINAL)]).units,
    )
    kinds = {unit.experiment for unit in units}
    others = [one.units(short)[0] for name, one in known_experiments().items() if name not in kinds]
    return dataclasses.replace(alone, units=(*units, *others))
