"""`time`: nanoseconds a tick on this machine, through pytest-benchmark."""

from pathlib import Path

import rich_click as click

from bench.cli import options
from bench.cli.progress import progress
from bench.cli.screen import console, frame_table


@click.command("time")
@options.law
@options.regulator
@options.representation
@options.arm
@click.option("--quick", is_flag=True, help="Fewer passes: rougher numbers in a fraction of the time.")
@click.option("--benchmark-json", default="", metavar="FILE", help="The samples, as pytest-benchmark reads them.")
@click.option(
    "--out", type=options.PATH, metavar="FOLDER", show_default="results/timings, for a full run", help="Folder."
)
def COMMAND(laws, regulators, representations, arms, quick, benchmark_json, out: Path | None):
    """Time every law, engine and arm per tick, interleaved with a fixed reference kernel.

    A full run replaces this machine's file in results/timings; a narrowed or --quick run needs --out.
    """
    import tasks
    from bench import timing

    if out is None and (laws or regulators or representations or arms or quick):
        raise click.UsageError(
            "a narrowed or --quick run does not replace the full one in results/timings (try: --out results/timed)"
        )
    folder = out or timing.FOLDER
    named = tuple(dict.fromkeys(arms)) or tuple(tasks.arm_names())
    for arm in named:
        tasks.arm(arm)  # a word that names none is refused before anything is compiled
    with progress("samples") as steps:

        def report(done):
            steps.now(f"{'timing' if done.total else 'compiling'} {done.name}", done.done, done.total or None)

        chosen = options.chosen(laws, regulators, representations, costings=True)
        run = timing.run_apart if laws else timing.run
        path = run(chosen, folder=folder, quick=quick, report=report, arms=named, json_file=benchmark_json)
    console().print(frame_table(timing.table(path), "Time per tick"))
    console().print(frame_table(timing.arm_table(path), "Time per tick on arms"))
    console().print(f"wrote {path}" + (f" and {benchmark_json}" if benchmark_json else ""))
