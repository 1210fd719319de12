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
@click.option("--benchmark-json", default="", metavar="FILE", help="The samples, as pytest-benchmark reads them.")
def COMMAND(laws, regulators, representations, arms, quick, benchmark_json):
    """Time every law, engine and arm per tick, interleaved with a fixed reference kernel; into results/timings."""
    import tasks
    from bench import timing

    named = tuple(dict.fromkeys(arms)) or tuple(tasks.arm_names())
    for arm in named:
        tasks.arm(arm)  # a word that names none is refused before anything is compiled
    with progress("samples") as steps:

        def report(done):
            steps.now(f"{'timing' if done.total else 'compiling'} {done.name}", done.done, done.total or None)

        chosen = options.chosen(laws, regulators, representations, costings=True)
        run = timing.run_apart if laws else timing.run
        path = run(chosen, quick=quick, report=report, arms=named, json_file=benchmark_json)
    console().print(frame_table(timing.table(path), "Time per tick"))
    console().print(frame_table(timing.arm_table(path), "Time per tick on arms"))
    console().print(f"wrote {path}" + (f" and {benchmark_json}" if benchmark_json else ""))
