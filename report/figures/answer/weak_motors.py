"""How near the advised law is to the fastest motions where the command has a bound (results/weak-motors)."""

from typing import Any

from bench.findings.selection.checked import (
    LITTLE_DEG,
    NEAR_LEAST,
    WeakMotors,
    count_by_bound,
    count_weak_motors,
    read_weak_motors,
)
from report.figures.kit import html
from report.figures.kit.page import Run

TABLE = html.Table(
    "Bound on the command, divided by kp [rad] | Situations | Situations where a law is advised | "
    f"Of these: settling time at most {NEAR_LEAST:g} times the least time [%]:.0f | "
    f"Of these: overshoot below {LITTLE_DEG:g}° [%]:.0f | "
    "Median of the settling time, divided by the least time:.2f | "
    "Median time of the linear loop near the goal, divided by the least time:.2f"
)


def facts(_: Run) -> dict[str, Any]:
    """Return the shares in a sentence, and the table of the classes of the bound."""
    rows = read_weak_motors()
    classes = count_by_bound(rows)
    modelled = count_weak_motors(rows[rows["inertia"] == 1.0])
    return {
        "of": len(rows),
        "near": f"{100 * classes[-1].near:.0f}",
        "little": f"{100 * classes[-1].little:.0f}",
        "modelled": modelled.of,
        "modelled_near": f"{100 * modelled.near:.0f}",
        "modelled_little": f"{100 * modelled.little:.0f}",
        "why": explain(classes),
        "finding": describe_classes(classes),
        "table": TABLE(map(_row, classes)),
    }


def explain(classes: list[WeakMotors]) -> str:
    """Say at which bounds the linear loop alone takes longer than the goal that was set."""
    slow = [one for one in classes[:-1] if one.linear > NEAR_LEAST]
    if not slow:
        return "Near the goal the linear loop is fast enough in most of the situations of each class"
    return (
        f"From a bound of {slow[0].low:.2g} kp on, the gains alone are too low: in at least half of the situations the "
        f"linear loop near the goal needs more than {NEAR_LEAST:g} times the least time, whatever the law"
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
