"""What the law that brakes late takes, measured beside its neighbours; and what was tried on the way to it."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.findings.theory.isotropic import EQUATIONS, LEAST_RAD, settling
from bench.law.contender import PAPERS_GAINS
from bench.law.equation import ANGLE, CHORD, Equation
from report.figures.comparison import comparison_peak
from report.figures.comparison.comparison_rows import costs
from report.figures.comparison.comparison_tables import NEVER
from report.figures.comparison.new_law import greatest_pull, peak_gains, response
from report.figures.cost.operations import CALLS
from report.figures.kit import absent, families, html
from tasks.rules import RULES

NEW = "late-braking"
LATE = EQUATIONS[NEW]
NEIGHBOURS = ("rotation-matrix", "square-root", "hybrid", "sliding", "rotation-vector", "mrp", "mrp-linearized", NEW)
"""The 1980 law; the laws whose parts it has; the two whose response is linear; the fastest at equal gain."""

ROOTLESS = Equation(
    r"5 \sin\theta/(3 + 2\cos\theta),\ \tfrac52 \sin(\theta/2)",
    lambda theta: (
        5.0 * math.sin(theta) / (3.0 + 2.0 * math.cos(theta))
        if theta < 2.0 * math.pi / 3.0
        else 2.5 * math.sin(theta / 2.0)
    ),
)
"""5 s/(2 (2 + t)) within 120 degrees, where no root is taken, and 5 eps/2 beyond: once differentiable between."""

TRIED = {
    "A straight spring": ANGLE,
    "The quaternion's spring": CHORD,
    "A rational spring, no root within 120°": ROOTLESS,
    "The quaternion's spring, damper eased": CHORD._replace(added=LATE.added),
    "This spring, damper whole": LATE._replace(added=ANGLE.added),
    "This law": LATE,
}


def tried() -> html.Markdown:
    """A row a variant: slowest start, greatest pull, effort from a half turn, slowest start at equal peak."""
    return html.table(
        pd.DataFrame(
            {
                "Variant": what,
                "Slowest [s]": f"{slowest(equation, *PAPERS_GAINS):.3f}",
                "Peak [$K_p$]": f"{greatest_pull(equation):.2f}",
                "Effort": html.number(float(f"{effort(equation):.3g}")),
                "Slowest at equal peak [s]": f"{slowest(equation, *peak_gains(equation)):.3f}",
            }
            for what, equation in TRIED.items()
        )
    )


def slowest(equation: Equation, kp: float, kv: float) -> float:
    """The longest settling time [s] from rest, over angles to the half turn."""
    return max(settling(equation, angle, kp, kv, RULES.tolerance) for angle in np.linspace(LEAST_RAD, math.pi, 24))


def effort(equation: Equation) -> float:
    """Integral of the squared command from rest at a half turn [rad^2/s^3]."""
    return float(response(equation, math.pi, *PAPERS_GAINS)[-1, -1])


def facts() -> dict:
    """From the equations: how slow and how strong this law is beside the straight spring, at equal gain and peak."""
    return {
        "slowest": f"{slowest(LATE, *PAPERS_GAINS):.3f}",
        "linear": f"{slowest(ANGLE, *PAPERS_GAINS):.3f}",
        "pull": f"{greatest_pull(LATE):.2f}",
        "chord_s": f"{slowest(CHORD, *PAPERS_GAINS):.3f}",
        "effort": html.number(round(effort(LATE))),
        "straight_effort": html.number(round(effort(ANGLE))),
        "peak_s": f"{slowest(LATE, *peak_gains(LATE)):.2f}",
        "peak_straight_s": f"{slowest(ANGLE, *peak_gains(ANGLE)):.2f}",
        "peak_chord_s": f"{slowest(CHORD, *peak_gains(CHORD)):.2f}",
        "level": html.number(comparison_peak.LEVEL),
    }


def counts(counted: pd.DataFrame) -> dict:
    """Operations a tick, typical and worst, of this law, the 1980 law and the hybrid; dashes without rows.

    Args:
        counted: rows of costs.parquet about the free body.
    """
    totals = counted[counted["stage"] == "total"].set_index(["contender", "branch"])["flops"]
    wanted = {
        "flops": (NEW, "typical"),
        "flops_worst": (NEW, "worst"),
        "flops_1980": ("rotation-matrix", "typical"),
        "flops_hybrid": ("hybrid", "typical"),
    }
    return {key: int(totals[place]) if place in totals.index else html.MISSING for key, place in wanted.items()}


def measured(rows: pd.DataFrame, counted: pd.DataFrame) -> html.Markdown:
    """A row a neighbour: settling, effort and peak at equal gain; settling at equal peak; a tick; noise it withstands.

    Args:
        rows: of `comparison_rows.common`. counted: rows of costs.parquet about the free body.
    """
    there = rows[rows["contender"].isin(NEIGHBOURS)] if (rows["contender"] == NEW).any() else rows.iloc[:0]
    return absent.table(there, lambda found: _measured(found, counted))


def _measured(rows: pd.DataFrame, counted: pd.DataFrame) -> html.Markdown:
    times, efforts = costs(rows, "settling_time_s"), costs(rows, "effort")
    totals = counted[(counted["branch"] == "typical") & (counted["stage"] == "total")].set_index("contender")
    at_peak, noise = comparison_peak.rows(), absent.robustness(axis="half-turn-noise")
    lines = []
    for name in (name for name in NEIGHBOURS if name in times):
        calls = int(totals.loc[name, list(CALLS)].sum())
        flops = int(totals.loc[name, "flops"])
        lines.append(
            {
                "Law": families.link(name, families.word(name)),
                "Median [s]": _seconds(times[name].median()),
                "Slowest [s]": _seconds(times[name].max()),
                "Effort": html.number(float(f"{efforts[name].median():.3g}")),
                "Peak": html.number(round(rows.loc[rows["contender"] == name, "peak_u"].max())),
                "Slowest at equal peak [s]": _slowest_of(at_peak, name),
                "A tick": html.together(f"{flops} + {calls}" if calls else f"{flops}"),
                "Held from [rad]": _held_from(noise, name),
            }
        )
    return html.table(pd.DataFrame(lines), words=("A tick", "Held from [rad]"))


def _seconds(value: float) -> str:
    return f"{value:.3f}" if np.isfinite(value) else NEVER


def _slowest_of(rows: pd.DataFrame, name: str) -> str:
    own = rows[rows["contender"] == name] if len(rows) else rows
    if own.empty:
        return html.MISSING
    return _seconds(own["settling_time_s"].max()) if (own["outcome"] == "settled").all() else NEVER


def _held_from(noise: pd.DataFrame, name: str) -> str:
    """The least level of the worst-case noise at which some start never settles."""
    own = noise[noise["contender"] == name] if len(noise) else noise
    if own.empty:
        return html.MISSING
    lost = own.loc[own["outcome"] != "settled", "level"]
    return f"{lost.min():g}" if len(lost) else f"not to {own['level'].max():g}"
