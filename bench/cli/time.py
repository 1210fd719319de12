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
@click.option("--quick", is_flag=True, help="Fewer passes: rougher numbers in a fraction of the time.")
@click.option(
    "--out",
    type=options.PATH,
    metavar="FOLDER",
    help="Folder of the machine's file; by default results/timings for everything, results/timings-partial for less.",
)
def COMMAND(
    laws: options.Files, regulators: options.Words, representations: options.Words, arms: options.Words, quick: bool,
    out: Path | None,
) -> None:  # fmt: skip
    """Time every law, engine and arm per tick, interleaved with a fixed reference kernel.

    results/timings is under version control. A run with --quick, or of less or more than everything, does not write
    there unless --out names it.
    """
    import tasks
    from bench.running import timing

    named = tuple(dict.fromkeys(arms)) or tuple(tasks.arm_names())
    for arm in named:
        tasks.arm(arm)  # a word that names none is refused before anything is compiled
    with progress("samples") as steps:

        def report(done: timing.Progress) -> None:
            steps.now(f"{'timing' if done.total else 'compiling'} {done.name}", done.done, done.total or None)

        chosen = options.chosen(laws, regulators, representations, costings=True)
        run = timing.run_apart if laws else timing.run
        folder = out or folder_for(laws, regulators, representations, arms, quick)
        path = run(chosen, folder, quick=quick, report=report, arms=named)
    for arm, table in timing.tables(path):
        console().print(frame_table(table, f"\nTime per tick{f' on {arm}' if arm else ''}"))
    console().print(f"wrote {shown_path(path)}")


def folder_for(*narrowing: Any) -> Path:
    """Return the default folder of timings: the one under version control only if everything was timed."""
    return PARTIAL if any(narrowing) else WHOLE
