"""The page that gives an overview of robustness."""

import numpy as np

import tasks
from report.figures.kit import families
from report.figures.kit.page import Run, given
from report.figures.kit.tables import Table
from report.figures.robustness.reach import LOST, SLOWED, WALKS, is_fine, reaches
from report.figures.robustness.reach_map import reach_map
from report.figures.robustness.rows import HELD_RAD, along, listed, plain, starts

PAGES = {
    "control-rate": "17-control-rate.md",
    "delay": "18-delay.md",
    "attitude-noise": "19-noise.md",
    "rate-noise": "19-noise.md",
    "half-turn-noise": "20-half-turn-noise.md",
    "saturation": "21-saturation.md",
    "inertia": "22-inertia.md",
    "uneven-inertia": "22-inertia.md",
    "spin": "23-spin.md",
    "moving-goal": "24-moving-goals.md",
    "moving-goal-rate": "24-moving-goals.md",
    "moving-goal-untold": "24-moving-goals.md",
}
"""Perturbation -> the page about it."""

AXES = Table("Axis | Levels")


def facts(run: Run) -> dict:
    """How many laws each perturbation hurts, and how many each law; without the negative controls."""
    found = reaches(run)
    laws = [law for law in found if law not in families.CONTROLS]
    if not laws:
        return {}
    hurt = [sum(not is_fine(found[law][i]) for law in laws) for i in range(len(WALKS))]
    avoidable = hurt[:-1]  # a goal that moves without feedforward escapes every law
    count = {law: sum(not is_fine(one) for one in found[law][:-1]) for law in laws}
    fewest, most = min(count.values()), max(count.values())
    harmless = [walk.words for walk, number in zip(WALKS, hurt, strict=True) if not number]
    hardest = [walk.words for walk, number in zip(WALKS, avoidable, strict=False) if number == max(avoidable)]
    return {
        "laws": len(laws),
        "axes": len(PAGES),
        "lost": f"{100 * LOST:g}",
        "slowed": f"{SLOWED:g}",
        "held_deg": f"{np.degrees(HELD_RAD):g}",
        "starts": starts(along(run, "delay")),
        "episodes": sum(len(along(run, name)) for name in PAGES),
        "best": listed(families.word(law) for law in laws if count[law] == fewest),
        "fewest": fewest,
        "weakest": listed(families.word(law) for law in laws if count[law] == most),
        "most": most,
        "harmless": listed(harmless) if harmless else "nothing",
        "hardest": listed(hardest),
        "hardest_n": max(avoidable),
        "untold_n": hurt[-1],
    }


def tables(_: Run) -> dict:
    """Every perturbation: its page, what it is, its levels."""
    lines = []
    for axis, page in ((tasks.axis(name), page) for name, page in PAGES.items()):
        unit = "" if axis.unit == "1" else f" {axis.unit.replace('^2', '²')}"
        lines.append((f"[{axis.title}]({page})", f"{', '.join(map(plain, axis.levels))}{unit}"))
    return {"tab_axes": AXES(lines)}


def figures(run: Run) -> dict:
    """Who gives way to what."""
    return {"robustness": given(reaches(run), reach_map)}
