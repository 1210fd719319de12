"""What `run` prints of a plan: its size in a few lines, or everything in it."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from bench.cli.paragraphs import Paragraph, listed, print_paragraphs
from bench.cli.screen import console, counted, shown_path
from bench.experiments.experiment import Unit
from bench.experiments.plan import Plan
from bench.experiments.suites import IDEAL_MOTORS, NOMINAL
from bench.running.schedulers import THREADS

LAW, CONTROLLER, ARM = ("", "contender", "law"), ("", "contender", "controller"), (" on ", "arm", "arm")
STARTS = (" from ", "selector", "start set")
PARTS = {
    "free-body": ("free body", "episode", (LAW, (" by ", "engine", "engine"), STARTS)),
    "arm": ("arms", "episode", (CONTROLLER, ARM, STARTS)),
    "contact": ("contact", "trial", (CONTROLLER, (" in ", "task", "task"), ARM)),
    "robustness": ("robustness", "episode", (LAW, (" under ", "selector", "perturbation"))),
}
"""Experiments whose size is said: head, word of an episode, and (word before, field of a unit, word) of each count."""

USUAL = ("", NOMINAL, IDEAL_MOTORS)
FEW = 3
"""Names up to this number are printed, more are counted."""


def print_size(plan: Plan, out: Path, workers: int, scheduler: str) -> None:
    """Print how much is run, how, and into which folder if it is there."""
    request, who = plan.request, counted(workers, "thread") if scheduler == THREADS else scheduler
    gains = f"kp {request.gains.kp:g}/s², kv {request.gains.kv:g}/s"
    settings = f"control period {request.dt_s:g} s, {gains}, seed {request.seed}; by {who}"
    into = [Paragraph("into", (shown_path(out),))] if out.exists() else []  # no path that is not there yet
    print_paragraphs(*_sizes(plan), Paragraph("with", (settings,)), *into)


def _sizes(plan: Plan) -> list[Paragraph]:
    episodes, all_units = plan.episodes(*PARTS), counted(len(plan.units), "unit")
    size = (
        f"{counted(episodes, 'episode')} in {all_units}"
        if episodes
        else f"{all_units}, which make rows without episodes"
    )
    found = [Paragraph("plan", (f"suite {plan.request.suite}: {size}",))]
    for name, (head, word, counts) in PARTS.items():
        units = plan.of(name)
        what = "".join(f"{before}{_few(units, field, one)}" for before, field, one in counts)
        varied = [unit for unit in units if unit.variation not in USUAL]
        what += f", {_few(varied, 'variation', 'other plant')}" if varied else ""
        if units:
            found.append(Paragraph(head, (f"{counted(sum(unit.episodes for unit in units), word)}: {what}",)))
    others = dict.fromkeys(unit.experiment for unit in plan.units if unit.experiment not in PARTS)
    return [*found, Paragraph("also", (listed(list(others)),))] if others else found


def _few(units: Sequence[Unit], field: str, word: str) -> str:
    names = list(dict.fromkeys(getattr(unit, field) for unit in units))
    return listed(names) if 0 < len(names) <= FEW else counted(len(names), word)


def print_all(plan: Plan) -> None:
    """Print every law and controller of a plan, and how many episodes each has, by place and start set or task."""
    touching = dict.fromkeys(unit.contender for unit in plan.of("contact"))
    if touching:
        console().print(f"controllers in contact: {', '.join(touching)}")
    for title, is_law in (("\nlaws", True), ("baselines", False)):
        some = [one.on_free_body for one in plan.contenders if (one.baseline is None) == is_law]
        if some:
            console().print(f"{title}: {', '.join(dict.fromkeys(some))}")
    sizes: dict[str, dict[str, Counter[str]]] = {}
    for unit in plan.of(*PARTS):
        what = unit.task if unit.experiment == "contact" else unit.selector
        place = ", ".join(filter(None, (unit.experiment, unit.engine, unit.arm)))
        varied = "" if unit.variation in USUAL else " of other plants"
        sizes.setdefault(place, {}).setdefault(what + varied, Counter())[unit.contender] += unit.episodes
    for place, sets in sizes.items():
        each = counted(len(set().union(*sets.values())), "contender")
        most = ", ".join(f"{name} {max(counts.values())}" for name, counts in sets.items())
        console().print(f"{place}: {most} (each of {each}, at most)")
