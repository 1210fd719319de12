"""A small plan with units of every kind, one of them a user's law's."""

import dataclasses
from pathlib import Path

from bench.contenders.law_file import load_law
from bench.contenders.registry import find_contender
from bench.experiments import plan
from bench.experiments.choice import Choice
from support.user_law import DAMPER, law_text


def plan_of_all_kinds(folder: Path) -> plan.Plan:
    """Units on the free body, an arm, in contact and in trouble; one of a user's law, whose file is in the folder."""
    path = folder / "mine.py"
    path.write_text(law_text(DAMPER))
    ours = find_contender("rotation-matrix")
    laws, short = [ours, find_contender("mine", (load_law(path),))], {"count": 2, "horizon_s": 0.05}
    alone = plan.make("quick", laws, Choice(start_sets=("paper",), engines=("ideal-rk4",)), **short)
    choices = (
        Choice(("arm-regulation",), ("clear",), ("native",), ("ur5e",), ("geometric",), ("solve",)),
        Choice(("wrench-probe",), arms=("ur5e",), controllers=("hybrid-base+inverse",)),
        Choice(axes=("delay",)),
    )
    others = [plan.make("quick", [] if choice.controllers else [ours], choice, **short) for choice in choices]
    contenders = dict.fromkeys(one for each in (alone, *others) for one in each.contenders)
    return dataclasses.replace(
        alone,
        units=(*alone.units, *others[0].units),
        contacts=others[1].contacts[:1],
        troubles=others[2].troubles,
        contenders=tuple(contenders),
    )
