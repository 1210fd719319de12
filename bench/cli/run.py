"""`run`: carry out a suite, or a part of it."""

import time
from datetime import timedelta
from pathlib import Path
from typing import Any

import rich_click as click
from click.exceptions import Exit

from bench.base.provenance import read_provenance
from bench.cli import options
from bench.cli.progress import progress
from bench.cli.screen import console, counted, examples, shown_path
from bench.experiments.experiment import Unit
from bench.experiments.request import IN_CONTACT, WITHOUT, Request, check_workers, integrators
from bench.law.inputs import Gains
from bench.running.schedulers import check_scheduler


@click.command("run", epilog=examples("run"))
@click.option("--suite", default="default", show_default=True, metavar="NAME", help="quick, default or full.")
@options.law
@options.regulator
@options.representation
@options.controller
@options.several("--task", "tasks", "Only this task")
@options.arm
@options.jacobian
@options.inverse
@options.several("--variation", "variations", "On arms, a plant that differs so")
@options.several("--axis", "axes", "Only under this perturbation, as delay")
@options.several("--experiment", "experiments", "Only this experiment")
@options.several("--starts", "start_sets", "Only this start set")
@options.several("--engine", "engines", "Only this engine")
@click.option(
    "--count",
    type=options.COUNT,
    help="At most so many starts of each set or level (sampled sets take any number), or poses in contact.",
)
@options.simulated
@click.option(
    "--horizon",
    "horizon_s",
    type=options.HORIZON,
    help="Longest simulated time in seconds; the suite's own by default.",
)
@click.option("--integrator", show_default=f"{WITHOUT}; in contact {IN_CONTACT}", metavar="NAME", help="MuJoCo's.")
@options.carried_out
@click.option("--out", type=options.PATH, default=options.LATEST, show_default="results/latest", help="Folder.")
@click.option(
    "--law-limit",
    type=options.LAW_LIMIT,
    metavar="SECONDS",
    show_default="10, or 30 of a unit that cannot be cut, and ten times what ours take",
    help="A --law that takes longer for 25 starts, or for a unit that cannot be cut, is stopped there; "
    "then all rows of these starts, or of the unit, say hung.",
)
@click.option("--dry-run", is_flag=True, help="Print the whole plan; run nothing.")
def COMMAND(
    suite: str, laws: options.Files, kp: float, kv: float, integrator: str | None, workers: int, scheduler: str,
    out: Path, law_limit: float | None, replace: bool, dry_run: bool, **words: Any,
) -> None:  # fmt: skip
    """Run a suite and store its episodes; a run that was stopped goes on where it was.

    The free body has laws alone; an arm also needs a Jacobian and an inverse. The suite has its own for each law. Name
    a Jacobian or an inverse, and all that go together are run on arms; a combination that cannot be is refused with
    the reason.

    A task in contact has controllers (bench list controllers) and trials of its own. It is run with the suite
    unless something is named that it does not take: another task, a regulator, a Jacobian, starts, an engine, ...

    Robustness is of the free body: under a perturbation (bench list axes), from initial conditions of its
    own, as a low control rate, delay, noise, saturation or a moving goal. Name one, and nothing else is run.
    """
    from bench.cli import planned
    from bench.experiments import plan as planning

    check_workers(workers)  # at once: a plan of arms' starts takes seconds
    check_scheduler(scheduler)
    words |= options.named(words["regulators"], words["jacobians"], words["inverses"])
    contenders = options.chosen(laws, words["regulators"], words["representations"])
    plan = planning.make(Request(suite, tuple(contenders), Gains(kp, kv), **integrators(integrator), **words))
    planned.print_size(plan, out, workers, scheduler)
    if dry_run:
        planned.print_all(plan)
        return
    from bench.running import run as running  # numba and mujoco take seconds; --dry-run and mistakes should not

    state = running.inspect(plan, out, replace)
    if state.done and not state.finished:
        console().print(f"going on: {len(state.done)} of {len(plan.units)} units are done")
    began = time.monotonic()
    with progress("episodes") as steps:
        left = {unit.key: unit.episodes for unit in plan.units if unit.key not in state.done}
        total = plan.episodes()
        steps.now("compiling the laws")

        def report(unit: Unit) -> None:
            if left.pop(unit.key, None) is None:
                return
            missing = sum(left.values())
            if missing:
                steps.now(unit.label, total - missing, total)
            else:
                steps.now(f"{counted(len(left), 'unit')} left" if left else "joining the tables")

        by: dict[str, Any] = {"workers": workers, "scheduler": scheduler, "law_limit_s": law_limit}
        did = running.run(plan, out, replace=replace, report=report, **by)
    took = f" in {timedelta(seconds=round(time.monotonic() - began))}" if did else ""
    console().print(f"{'wrote' if did else 'up to date:'} {shown_path(out)}{took}   (bench show {shown_path(out)})")
    if read_provenance(out)["lost"]:
        raise Exit(1)  # a law of the user's crashed or hung
