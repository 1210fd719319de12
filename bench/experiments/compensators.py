"""Laws with a state of their own under a constant disturbance, and the paper's law on R, whose spring they have."""

from __future__ import annotations

import numpy as np

import tasks
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.request import Request
from bench.law.contenders.registry import contenders, papers_laws
from bench.law.kinds import Stateful
from tasks.rules import ticks

DISTURBANCES = (0.0, 5.0, 20.0)
"""Lengths [rad/s^2]; over the paper's Kp, the sine of what a law without integral leaves: 2.9 and 11.5 degrees."""
DIRECTION = (1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0)
"""Direction of the disturbance, in the base frame."""
BAND_RAD = np.deg2rad(1.0)
"""One band for all starts: what a disturbance leaves does not depend on the start."""
STARTS = 64
HORIZON_S = 8.0
"""[s]. The slowest of the starts, 2 degrees short of 180, is settled by half of it."""
LEVEL_S = 0.12
"""CPU seconds a level."""


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit for each law."""
    each = request.count or STARTS
    return tuple(
        Unit("compensators", selector=name, count=each, total=each, horizon_s=request.horizon_s or HORIZON_S)
        for name in ("", *contenders("compensators"))
    )


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return a row a level of the disturbance."""
    from bench.engines.simulate_bodies import run_compensated

    one, starts = law_of(unit.selector), tasks.start_set("uniform", unit.count, seed=request.seed)
    found = []
    for level in DISTURBANCES:
        lasting, push = ticks(unit.horizon_s, request.dt_s), tuple(level * x for x in DIRECTION)
        given = request.gains, request.dt_s, lasting, float(BAND_RAD), push
        settling_s, left_rad, peak_u = run_compensated(one, starts, *given)
        times = settling_s[np.isfinite(settling_s)]
        found.append(
            {
                "law": one.name,
                "disturbance": level,
                "reads_rate": "yes" if one.measures_rate else "no",
                **request.gains._asdict(),
                "dt_s": request.dt_s,
                "horizon_s": unit.horizon_s,
                "starts": len(starts),
                "settled": len(times),
                "settling_median_s": float(np.median(times)) if len(times) else None,
                "settling_worst_s": float(np.max(times)) if len(times) else None,
                "left_rad": float(np.max(left_rad)),
                "peak_u": float(np.max(peak_u)),
            }
        )
    return found


def law_of(name: str) -> Stateful:
    """Return the law of that name; for an empty name the paper's on R."""
    from bench.engines.simulate_bodies import without_state

    if name:
        return contenders("compensators")[name]
    return without_state(next(one for one in papers_laws() if one.representation is None).regulator)


def prepare(request: Request, unit: Unit) -> None:
    """Compile the loop and the law."""
    from bench.engines.simulate import compiled_loop
    from bench.engines.simulate_bodies import parts_of

    compiled_loop("state")
    parts_of(law_of(unit.selector))


EXPERIMENT = Experiment.of(
    globals(),
    "laws with a state of their own",
    cost_s=lambda unit: LEVEL_S * len(DISTURBANCES),
    compiles=False,
)
