"""The page on the law that brakes late: how slow, strong and dear it is."""

import math

import numpy as np
import pandas as pd

from bench.experiments.tables.run import FREE_BODY, Run
from bench.export.short import write_short
from bench.findings.amounts import capitalize, count_of, join_words
from bench.findings.proofs.certificate import read_certificates
from bench.findings.selection.regions import facts_of, find_default
from bench.findings.selection.sensitivity import tune
from bench.findings.theory.closed_form import linear_settling
from bench.findings.theory.isotropic import EQUATIONS, LEAST_RAD, settling
from bench.law.display import Equation
from bench.law.inputs import PAPERS_GAINS
from report.figures.cost.cost import CALLS
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, responsive_picture
from tasks.rules import RULES

NEW = "late-braking"
RATIOS = 0.5, 0.7, 1.0, 1.5
"""Damping ratios at which it is compared with a linear system."""

LATE = EQUATIONS[NEW]
PAPERS = "rotation-matrix"


def facts(run: Run) -> dict:
    """Return by the equations how slow and strong this law is against the straight spring; and operations a tick."""
    counted = run.any_rows("costs", **FREE_BODY)
    proved = read_certificates()[NEW]
    spent = counted[counted["stage"] == "total"].set_index(["contender", "branch"])
    return {
        "at_peak": compare_at_equal_peak(),
        **{name: f"{proved['settling']['upper']:{form}}" for name, form in (("slowest", ".3f"), ("bound", ".4f"))},
        "linear": f"{linear_settling(*PAPERS_GAINS):.3f}",
        **{name: f"{proved[name]:g}" for name in ("rate", "delta")},
        "drop": f"{proved['drop']:.3f}",
        "seconds": f"{proved['seconds']:.0f}",
        "lines": len([line for line in write_short(NEW).splitlines() if line]),
        "later": say_later([ratio for ratio in RATIOS if is_later(ratio)]),
        "later_of": join_words(map("{:g}".format, RATIOS)),
        **(describe_operations(spent.loc[NEW, "typical"]) if (NEW, "typical") in spent.index else {}),
        "pull": f"{max(map(LATE.spring, np.linspace(0.0, math.pi, 1801))):.2f}",  # max f
        "at_180": f"{LATE.spring(math.pi):.1f}",
        "default": families.word(find_default()),
        "default_at_180": f"{EQUATIONS[find_default()].spring(math.pi):.1f}",
        "springs": draw_springs((PAPERS, find_default(), NEW)),
    }


def compare_at_equal_peak() -> str:
    """Count the laws that are not ours and as fast as this one, each tuned for one peak command (`tune`)."""
    times = {one.law: one.peak_time for one in tune()}
    others = [time for law, time in times.items() if not facts_of(law).is_ours]
    as_fast = sum(time <= times[NEW] for time in others)
    if as_fast:
        rivals = f"{capitalize(count_of(as_fast, len(others), 'published and adapted laws'))} need no more time."
    else:
        best = f"With the best of the {len(others)} published and adapted laws"
        rivals = f"{best}, this time is {min(others):.2f}/√p seconds."
    needed = f"the body settles from 99 % of the starts within {times[NEW]:.2f}/√p seconds with late braking"
    return f"At equal peak command p [rad/s²], {needed}. {rivals}"


def say_later(ratios: list[float]) -> str:
    """Say at which damping ratios this law settles later than a linear system."""
    if not ratios:
        return "at none of these ratios"
    if len(ratios) == len(RATIOS):
        return "at all these ratios"
    earlier = [ratio for ratio in RATIOS if ratio not in ratios]
    late, others = (join_words(map("{:g}".format, each)) for each in (ratios, earlier))
    return f"at the damping ratios {late}, but not at {others}"


def is_later(ratio: float) -> bool:
    """Tell whether this law's slowest start settles a millisecond later than a linear system of this damping ratio."""
    kp = PAPERS_GAINS[0]
    kv = 2.0 * ratio * math.sqrt(kp)
    return longest(LATE, kp, kv) > linear_settling(kp, kv) + 1e-3


def describe_operations(row: pd.Series) -> dict[str, str]:
    """Say how many operations a row of costs.parquet has, with its square roots and trigonometric calls."""
    roots, calls = int(row["sqrt"]), int(row[list(CALLS)].sum())
    rooted = "one square root" if roots == 1 else f"{roots or 'no'} square roots"
    called = f"{calls} calls of trigonometric functions" if calls else "no trigonometric function"
    return {"operations": f"{int(row['flops'])} operations, among them {rooted} and {called}"}


def longest(equation: Equation, kp: float, kv: float) -> float:
    """Return the longest settling time [s] from rest, over angles up to 180°."""
    return max(settling(equation, angle, kp, kv, RULES.tolerance) for angle in np.linspace(LEAST_RAD, math.pi, 24))


@responsive_picture
def draw_springs(shown: tuple[str, ...], narrow: bool) -> Drawing:
    """Draw the command from rest of this law, of the advised one and of the paper's first, over Kp."""
    figure, axes = style.panels(height=2.6, narrow=narrow)
    angles = np.linspace(0.0, math.pi, 181)
    for law in shown:
        f = [EQUATIONS[law].spring(angle) for angle in angles]
        axes.plot(np.degrees(angles), f, color=style.look(law).colour)
        style.label_line(axes, 182.0, f[-1], families.word(law), style.look(law).colour)
    axes.set(xlim=(0, 180), ylim=(0, None), xticks=range(0, 181, 30))
    axes.set(xlabel="angle to the goal [deg]", ylabel="command from rest / kp")
    ends = join_words(f"{EQUATIONS[law].spring(math.pi):.1f} kp by {families.word(law)}" for law in shown)
    return figure, f"Command from rest against the angle to the goal. At 180 degrees it is {ends}."
