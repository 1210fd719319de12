"""What `run` prints of a plan: its size in a few lines, or everything in it."""

from pathlib import Path

from bench.cli.paragraphs import Paragraph, listed, print_paragraphs
from bench.cli.screen import console, counted, shown_path
from bench.experiments.plan import Plan
from bench.experiments.suites import NOMINAL
from bench.running.schedulers import THREADS

LAW, CONTROLLER, ARM = ("", "contender", "law"), ("", "contender", "controller"), (" on ", "arm", "arm")
STARTS = (" from ", "selector", "start set")
PARTS = {
    "free-body": ("free body", "episode", (LAW, (" by ", "engine", "engine"), STARTS)),
    "arm": ("arms", "episode", (CONTROLLER, ARM, STARTS)),
    "contact": ("contact", "trial", (CONTROLLER, (" in ", "task", "task"), ARM)),
    "robustness": ("robustness", "episode", (LAW, (" under ", "selector", "perturbation"))),
}
"""Experiments whose size is said: head, word of an episode, and (before it, field of a unit, word) of what is counted.

Of other experiments the name is said.
"""

FEW = 3
"""Names up to this number are printed, more are counted."""


def print_size(plan: Plan, out: Path, workers: int, scheduler: str) -> None:
    """Print how much is run, how, and into which folder."""
    print_paragraphs(*size(plan, out, workers, scheduler))


def size(plan: Plan, out: Path, workers: int, scheduler: str) -> list[Paragraph]:
    """Return the size and settings of a plan and its folder as paragraphs."""
    return [*_sizes(plan), _settings(plan, workers, scheduler), Paragraph("into", (shown_path(out),))]


def _sizes(plan: Plan) -> list[Paragraph]:
    size = f"{counted(plan.episodes(*PARTS), 'episode')} in {counted(len(plan.units), 'unit')}"
    found = [Paragraph("plan", (f"suite {plan.settings.suite}: {size}",))]
    for name, (head, word, counts) in PARTS.items():
        units = plan.of(name)
        what = "".join(f"{before}{_few(units, field, one)}" for before, field, one in counts)
        varied = [unit for unit in units if unit.variation not in ("", NOMINAL)]
        what += f", {_few(varied, 'variation', 'model error')}" if varied else ""
        if units:
            found.append(Paragraph(head, (f"{counted(sum(unit.episodes for unit in units), word)}: {what}",)))
    others = dict.fromkeys(unit.experiment for unit in plan.units if unit.experiment not in PARTS)
    return [*found, Paragraph("also", (listed(list(others)),))] if others else found


def _few(units, field: str, word: str) -> str:
    names = list(dict.fromkeys(getattr(unit, field) for unit in units))
    return listed(names) if 0 < len(names) <= FEW else counted(len(names), word)


def _settings(plan: Plan, workers: int, scheduler: str) -> Paragraph:
    given, who = plan.settings, counted(workers, "thread") if scheduler == THREADS else scheduler
    gains = f"kp {given.gains.kp:g}/s², kv {given.gains.kv:g}/s"
    return Paragraph("with", (f"control period {given.dt_s:g} s, {gains}, seed {given.seed}; by {who}",))


def print_all(plan: Plan) -> None:
    """Every law, engine, arm, start set, perturbation, controller and task of a plan."""
    ours = [one for one in plan.contenders if one.regulator.assemble is None]
    baselines = [one for one in plan.contenders if one.regulator.assemble is not None]
    if ours:
        console().print(f"\nlaws: {', '.join(dict.fromkeys(one.on_free_body for one in ours))}")
    if baselines:
        console().print(f"baselines: {', '.join(dict.fromkeys(one.on_free_body for one in baselines))}")
    alone, contacts, perturbed = plan.of("free-body", "arm"), plan.of("contact"), plan.of("robustness")
    sizes: dict = {}
    for unit in alone:
        place = f"{unit.engine}, {unit.arm}" if unit.arm else unit.engine
        varied = "" if unit.variation == NOMINAL else " under each variation"
        sizes.setdefault(place, {}).setdefault(unit.selector + varied, unit.total)
    for place, sets in sizes.items():
        on = {unit.contender for unit in alone if unit.arm and place.endswith(f", {unit.arm}")}
        each = f"each of {counted(len(on), 'controller')}" if on else "each law"
        console().print(f"{place}: " + ", ".join(f"{name} {total}" for name, total in sets.items()) + f" ({each})")
    if perturbed:
        levels = {unit.selector: unit.episodes // unit.count for unit in perturbed}
        each = ", ".join(f"{name} {number} x {perturbed[0].count}" for name, number in levels.items())
        laws = counted(len({unit.contender for unit in perturbed}), "law")
        console().print(f"perturbations, levels x starts: {each} (each of {laws})")
    if contacts:
        _print_contacts(contacts)


def _print_contacts(units) -> None:
    console().print(f"controllers in contact: {', '.join(dict.fromkeys(unit.contender for unit in units))}")
    trials: dict = {}
    for unit in units:
        of_task = trials.setdefault(unit.arm, {}).setdefault(unit.task, {})
        of_task[unit.contender] = of_task.get(unit.contender, 0) + unit.episodes
    for arm, by_task in trials.items():
        each = ", ".join(f"{task} {max(counts.values())}" for task, counts in by_task.items())
        console().print(f"in contact, {arm}: {each} (each controller, an impedance fewer)")
