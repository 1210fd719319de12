"""The numbers in the sentences on loops that a linear one stands for: control rate, delay, inertia."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import pandas as pd

import tasks
from bench.findings.theory import robustness_theory
from report.figures.kit import families
from report.figures.robustness import robustness_margins, robustness_rows
from report.figures.robustness.robustness_words import DEG, ends, losses, medians, needs, signed, slower
from tasks.rules import RULES

EXACT = "rotation-vector"
"""The law that is the linear loop from rest at every angle."""


def theory(rows: pd.DataFrame, name: str) -> Callable[[float], float]:
    """Level -> settling time of the linear loop with the rows' gains [s], along an axis that it can be put on."""
    settling = functools.partial(robustness_theory.settling, *robustness_rows.gains(rows), RULES.tolerance)
    return {
        "control-rate": lambda level: settling(period_s=1.0 / level),
        "delay": lambda level: settling(delay_s=level),
        "inertia": lambda level: settling(inertia=level),
        "uneven-inertia": lambda level: max(settling(inertia=1.0 - level), settling(inertia=1.0 + level)),
    }[name]


def farthest_ms(rows: pd.DataFrame, name: str) -> float:
    """Largest difference of any start of EXACT from the linear loop's settling time [ms]."""
    own, curve = robustness_rows.of(rows, EXACT), theory(rows, name)
    return 1000.0 * max(
        (abs(time - curve(level)) for time, level in zip(own["time_s"], own["level"], strict=True)), default=math.nan
    )


LOOP = (
    "n laws worst nominal times losses limit crossover phase delay_ms used far_ms theory0 theory1 least most most_law "
    "within"
)
"""Keys of `loop`."""


@needs(LOOP)
def loop(rows: pd.DataFrame, name: str) -> dict:
    """Of the pages on the control rate and on delay."""
    kp, kv = robustness_rows.gains(rows)
    worst, curve, ratio = robustness_rows.worst(rows, name), theory(rows, name), slower(rows, name)
    margin = robustness_theory.delay_margin(kp, kv)
    return {
        **ends(rows, name),
        "nominal": robustness_rows.said(robustness_rows.nominal(tasks.axis(name)), name),
        "limit": f"{robustness_theory.least_rate(kp, kv):g}",
        "times": f"{worst / robustness_theory.least_rate(kp, kv):g}",
        "crossover": f"{robustness_theory.crossover(kp, kv):.1f}",
        "phase": f"{DEG * robustness_theory.phase_margin(kp, kv):.0f}",
        "delay_ms": f"{1000.0 * margin:.0f}",
        "used": f"{100.0 * (worst if name == 'delay' else 0.5 / worst) / margin:.0f}",
        "far_ms": f"{farthest_ms(rows, name):.1g}",
        "theory0": f"{curve(robustness_rows.nominal(tasks.axis(name))):.3f}",
        "theory1": f"{curve(worst):.3f}",
        "least": signed(ratio.min()),
        "most": signed(ratio.max()),
        "most_law": families.word(ratio.idxmax()),
        "within": "all of them do" if robustness_margins.is_within(rows, name) else "not all of them do",
    }


@needs(
    "n laws worst losses far_ms light heavy fastest fastest_s damped uneven_losses slowest slowest_law uneven0 uneven1 "
    "path"
)
def inertia(rows: pd.DataFrame, uneven: pd.DataFrame) -> dict:
    """Of the page on inertia."""
    kp, kv = robustness_rows.gains(rows)
    curve, levels = theory(rows, "inertia"), robustness_rows.levels(rows)
    times = {level: curve(level) for level in levels}
    quickest = min(times, key=lambda level: times[level])
    ratio, path = (
        slower(uneven, "uneven-inertia"),
        medians(uneven, "path_ratio").loc[max(robustness_rows.levels(uneven))],
    )
    uneven_curve = theory(uneven, "uneven-inertia")
    return {
        **ends(rows, "inertia"),
        "far_ms": f"{farthest_ms(rows, 'inertia'):.1g}",
        "light": f"{times[levels[0]]:.2f} s at {levels[0]:g}",
        "heavy": f"{times[levels[-1]]:.2f} s at {levels[-1]:g}",
        "fastest": f"{quickest:g}",
        "fastest_s": f"{times[quickest]:.2f}",
        "damped": f"{kv * kv / (4.0 * kp):g}",
        "uneven_losses": losses(uneven, "uneven-inertia"),
        "slowest": f"{100.0 * (ratio.max() - 1.0):.0f}",
        "slowest_law": families.word(ratio.idxmax()),
        "uneven0": f"{uneven_curve(0.0):.2f}",
        "uneven1": f"{uneven_curve(max(robustness_rows.levels(uneven))):.2f}",
        "path": f"{path.median():.2f}",
    }
