"""`time`: nanoseconds a tick on this machine, through pytest-benchmark."""

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
def COMMAND(laws, regulators, representations, arms, quick):
    """Time every law, engine and arm per tick, interleaved with a fixed reference kernel; into results/timings."""
    import tasks
    from bench import timing

    named = tuple(dict.fromkeys(arms)) or tuple(tasks.arm_names())
    for arm in named:
        tasks.arm(arm)  # a word that names none is refused before anything is compiled
    with progress("samples") as steps:

        def told(done):
            steps.now(f"{'timing' if done.total else 'compiling'} {done.name}", done.done, done.total or None)

        chosen = options.chosen(laws, regulators, representations, costings=True)
        path = (timing.run_apart if laws else timing.run)(chosen, quick=quick, told=told, arms=named)
    console().print(frame_table(timing.table(path), "Time per tick"))
    console().print(frame_table(timing.arm_table(path), "Time per tick on arms"))
    console().print(f"wrote {path}")
