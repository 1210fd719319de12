"""What claims ask beyond the suites' episodes: laws at single states, a few episodes, coordinates, and arms.

A probe measures one thing: `PROBES` has each by the word that its rows have. It is run with every suite, from starts of
its own, and depends on the gains, the control period and the seed of the run alone. Claims read the rows
(`bench.findings.claims`), and hold them against theory; no probe knows a criterion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

from bench.experiments import arm as on_arms
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.probe_values.arms import SIX_JOINTS
from bench.experiments.probes import (
    arms,
    commands,
    coordinates,
    sliding,
    turns,
    variables,
)
from bench.experiments.probes.number import Number
from bench.experiments.request import Request


class Probe(NamedTuple):
    """What measures one thing.

    Attributes:
        measure: (request, unit) -> its numbers.
        cost_s: CPU seconds that it usually takes, on each arm if it is of arms.
        arms: The arms that it runs on; None if it is of no arm; empty for those of the suite.
        needs_real_poles: Whether it needs gains with real poles.
    """

    measure: Callable[[Request, Unit], Iterable[Number]]
    cost_s: float = 0.2
    arms: tuple[str, ...] | None = None
    needs_real_poles: bool = False


PROBES = {
    "small-turn": Probe(turns.measure_small_turns, 1.0),
    "larger-turn": Probe(turns.measure_larger_turns),
    "one-angle": Probe(turns.measure_one_angle),
    "near-goal": Probe(turns.measure_near_goals),
    "beside-pole": Probe(turns.measure_beside_poles, 2.0),
    "wrong-inertia": Probe(turns.measure_perturbed, 1.0),
    "moving-goal": Probe(turns.measure_perturbed, 2.0),
    "sliding-decay": Probe(sliding.measure_decay, needs_real_poles=True),
    "sliding-bound": Probe(sliding.measure_bound, needs_real_poles=True),
    "sliding-frames": Probe(sliding.measure_frames, needs_real_poles=True),
    "sliding-noise": Probe(
        sliding.measure_noise, 1.0, needs_real_poles=True
    ),
    "arm-curve": Probe(arms.measure_curves, 3.0, ()),
    "arm-pole": Probe(arms.measure_poles, 2.0, ()),
    "arm-acceleration": Probe(
        arms.measure_accelerations, 0.1, SIX_JOINTS
    ),
    "contact-cost": Probe(arms.measure_contact_costs, 5.0),
    "error": Probe(commands.measure_errors, 1.0),
    "error-search": Probe(commands.search_errors),
    "command-at-pole": Probe(commands.measure_at_poles),
    "command-near-pole": Probe(commands.measure_near_poles),
    "command-jump": Probe(commands.measure_jumps),
    "largest-B": Probe(commands.measure_B),
    "near-zero": Probe(coordinates.measure_near_zero),
    "about-y": Probe(coordinates.measure_about_y),
    "moved-angles": Probe(coordinates.measure_moved_angles),
    "axes-of-angles": Probe(coordinates.measure_axes_of_angles),
    "work": Probe(coordinates.measure_work, 1.0),
    "forms": Probe(coordinates.measure_forms),
    "linear-terms": Probe(coordinates.measure_linear_terms),
    "ways": Probe(variables.measure_ways),
    "elimination": Probe(variables.measure_eliminations),
    "two-sets": Probe(variables.measure_sets),
    "twelve-forms": Probe(variables.measure_twelve_forms),
    "straight-line": Probe(variables.measure_lines),
}
"""Every probe by its word."""


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit a probe, of arms one on each arm."""
    of_suite = tuple(
        dict.fromkeys(unit.arm for unit in on_arms.units(request))
    )
    has_real_poles = sliding.has_sliding_variable(request.gains)
    found = []
    for word, probe in PROBES.items():
        if probe.needs_real_poles and not has_real_poles:
            continue
        for name in ("",) if probe.arms is None else probe.arms or of_suite:
            found.append(Unit("probes", arm=name, selector=word))
    return tuple(found)


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return a row a number."""
    found = []
    for number in PROBES[unit.selector].measure(request, unit):
        gains = number.gains or request.gains
        found.append(
            {
                "probe": unit.selector,
                **number.words,
                "arm": unit.arm,
                "case": number.case,
                "kp": gains.kp,
                "kv": gains.kv,
                "at": number.at,
                "outcome": number.outcome,
                "measure": number.measure,
                "value": number.value,
            }
        )
    return found


EXPERIMENT = Experiment.of(
    globals(),
    "what claims ask beyond the suites' episodes",
    prepare=turns.prepare,
    cost_s=lambda unit: PROBES[unit.selector].cost_s,
)
