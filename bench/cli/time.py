"""`time`: nanoseconds a tick on this machine."""

from pathlib import Path
from typing import Any

import rich_click as click

from bench.cli import options
from bench.cli.progress import progress
from bench.cli.screen import console, examples, frame_table, shown_path
from bench.experiments.tables.schema import RESULTS

WHOLE, PARTIAL = RESULTS / "timings", RESULTS / "timings-partial"


@click.command("time", epilog=examples("time"))
@options.law
@options.regulator
@options.representation
@options.arm
@click.option("--quick", is_flag=True, help="Fewer rounds: rougher numbers in a fraction of the time.")
@click.option(
    "--out",
    type=options.PATH,
    metavar="FOLDER",
    help="Folder of the machine's file; by default results/timings for everything, results/timings-partial for less.",
)
def COMMAND(
    laws: options.Files,
    regulators: options.Words,
    representations: options.Words,
    arms: options.Words,
    quick: bool,
    out: Path | None,
) -> None:
    """Time every law, engine and arm per tick, with a fixed reference kernel before each round.

    The benchmarks are tests/benchmarks; pytest tests/benchmarks --benchmark-only runs them, too.
    results/timings is under version control. A run with --quick, or of less or more than everything, does not write
    there unless --out names it.
    """
    import tasks
    from bench.regression import timings
    from bench.regression.timer import Progress

    named = tuple(dict.fromkeys(arms)) or tuple(tasks.arm_names())
    for arm in named:
        tasks.arm(arm)  # a word that names none is refused before anything is compiled
    with progress("benchmarks", "compiling") as steps:

        def report(timed: Progress) -> None:
            steps.now(f"timed {timed.name}", timed.done, timed.total)

        contenders = options.chosen(laws, regulators, representations, costings=True)
        folder = out or folder_for(laws, regulators, representations, arms, quick)
        path = timings.time_laws(contenders, folder, quick, report, named)
    for arm, table in timings.tables(timings.read(path)):
        console().print(frame_table(table, f"\nTime per tick{f' on {arm}' if arm else ''}"))
    console().print(f"wrote {shown_path(path)}")


def folder_for(*narrowing: Any) -> Path:
    """Return the default folder of timings: the one under version control only if everything was timed."""
    return PARTIAL if any(narrowing) else WHOLE
