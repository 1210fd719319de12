"""`time`: nanoseconds a tick on this machine, through pytest-benchmark."""

import rich_click as click

from bench.cli import options
from bench.cli.screen import console, count_progress, frame_table


@click.command("time")
@options.law
@options.regulator
@options.representation
@click.option("--quick", is_flag=True, help="Fewer passes: rougher numbers in a fraction of the time.")
def COMMAND(laws, regulators, representations, quick):
    """Time every law and engine per tick, interleaved with a fixed reference kernel; into results/timings."""
    from bench import timing

    with count_progress() as progress:
        bar = progress.add_task("compiling", total=None)

        def told(done):
            doing = "timing" if done.total else "compiling"
            progress.update(bar, total=done.total or None, completed=done.done, description=f"{doing} {done.name}"[:34])

        path = timing.run(options.chosen(laws, regulators, representations, costings=True), quick=quick, told=told)
    console().print(frame_table(timing.table(path), "Time per tick"))
    console().print(f"wrote {path}")
