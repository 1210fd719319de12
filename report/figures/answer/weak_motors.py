"""How near the advised law is to the fastest motions where the command has a bound (results/weak-motors)."""

import math
from typing import Any

import pandas as pd

from bench.experiments.tables.run import Run
from bench.findings.selection.checked import (
    LITTLE_DEG,
    NEAR_LEAST,
    WeakMotors,
    count_by_bound,
    count_weak_motors,
    read_weak_motors,
)
from report.figures.kit import html
from tasks.situation import read_situation

LOG_RATIO = math.log(180.0 / LITTLE_DEG)
RINGING_ZETA = LOG_RATIO / math.hypot(math.pi, LOG_RATIO)
"""Damping ratio below which the step response from 180° overshoots by LITTLE_DEG or more:
exp(-pi zeta/sqrt(1 - zeta^2)) is its overshoot as a share."""

TABLE = html.PageTable(
    "Bound on the command, divided by kp [rad] | Situations | Situations where a law is advised | "
    f"Share of these with a settling time of at most {NEAR_LEAST:g} times the least time [%]:.0f | "
    f"Share of these with an overshoot below {LITTLE_DEG:g}° [%]:.0f | "
    "Median of the settling time, divided by the least time:.2f | "
    "Median time of the linear loop near the goal, divided by the least time:.2f"
)


def facts(_: Run) -> dict[str, Any]:
    """Return the shares in a sentence, and the table of the classes of the bound."""
    rows = read_weak_motors()
    classes = count_by_bound(rows)
    modelled = count_weak_motors(rows[rows["inertia"] == 1.0])
    situations = [read_situation(str(word)) for word in rows["situation"]]
    rows = rows.assign(zeta=[at.zeta for at in situations], spin=[at.spin for at in situations])
    advised = rows[rows["advised"] != "none"]
    return {
        "of": len(rows),
        "near": f"{100 * classes[-1].near:.0f}",
        "little": f"{100 * classes[-1].little:.0f}",
        "modelled": modelled.of,
        "modelled_near": f"{100 * modelled.near:.0f}",
        "modelled_little": f"{100 * modelled.little:.0f}",
        "why": explain_time(advised),
        "overshoots": explain_overshoot(advised),
        "finding": describe_classes(classes),
        "table": TABLE(map(_row, classes)),
    }


def explain_time(advised: pd.DataFrame) -> str:
    """Say in how many situations the law takes longer than the goal that was set, and how many have which cause."""
    far = advised[advised["time"] > NEAR_LEAST * advised["least"]]
    linear = far["linear"] / far["least"]
    is_slow = linear > NEAR_LEAST
    is_wrong = ~is_slow & (far["inertia"] != 1.0)
    is_spun = ~is_slow & ~is_wrong & (far["spin"] > 0.0)
    rest = linear[~is_slow & ~is_wrong & ~is_spun]
    return (
        f"In {len(far)} of the {len(advised)} situations in which a law is advised, the law takes longer than "
        f"{NEAR_LEAST:g} times the least time. In {is_slow.sum()} of these, the gains are too low for any law: the "
        f"linear loop near the goal alone takes longer. In {is_wrong.sum()} of the others the inertia is not that of "
        f"the model, and in another {is_spun.sum()} the body spins at first. In the {len(rest)} that remain, the "
        f"linear loop alone takes at least {rest.min():.2f} times the least time, and the body must brake before that"
    )


def explain_overshoot(advised: pd.DataFrame) -> str:
    """Say in how many situations the law overshoots notably, and how many of these have which cause."""
    far = advised[advised["overshoot"] >= LITTLE_DEG]
    is_heavy = far["inertia"] > 1.0
    is_ringing = ~is_heavy & (far["zeta"] < RINGING_ZETA)
    return (
        f"The law overshoots by {LITTLE_DEG:g}° or more in {len(far)} situations. In {is_heavy.sum()} of these the "
        f"inertia is larger than that of the model; in {is_ringing.sum()} of the others the damping ratio is below "
        f"{RINGING_ZETA:.2f}, where the linear loop without a bound overshoots by as much from 180°"
    )


def describe_classes(classes: list[WeakMotors]) -> str:
    """Return the caption's first sentence: the weakest and the strongest motors."""
    weakest, strongest = classes[0], classes[-2]
    return (
        f"With bounds up to {weakest.high:.2g} kp, the advised law takes {weakest.ratio:.2f} times the least time in "
        f"the median; with bounds from {strongest.low:.2g} kp on, {strongest.ratio:.2f} times"
    )


def _row(one: WeakMotors) -> tuple:
    """Return the row of a class; the last class has all situations."""
    bounds = f"{one.low:.2g} to {one.high:.2g}"
    return bounds, one.of, one.advised, 100 * one.near, 100 * one.little, one.ratio, one.linear
