"""`history`: measure this commit, and show what the measured builds cost."""

from pathlib import Path

import rich_click as click

from bench.base.errors import BadResults
from bench.cli.screen import console, counted, examples, frame_table
from bench.experiments.tables.schema import RESULTS

SHOWN = 6
"""Builds that are shown, the newest."""

folder = click.option(
    "--folder",
    type=click.Path(path_type=Path),
    default=RESULTS / "history",
    show_default="results/history",
    metavar="FOLDER",
    help="The history.",
)


@click.group("history", epilog=examples("history"))
def COMMAND() -> None:
    """Measure every build, and show how its costs changed."""


@COMMAND.command("add")
@folder
@click.pass_context
def add(context: click.Context, folder: Path) -> None:
    """Time each law and some engines of this commit, count operations, and add a file to the history."""
    from bench.regression.history import append_build

    with console(stderr=True).status("compiling and timing: some minutes"):
        path = append_build(folder)
    console().print(f"added: {path}")
    context.invoke(show, folder=folder)


@COMMAND.command("show")
@folder
def show(folder: Path) -> None:
    """Show the newest builds: the time of a tick in steps of the reference kernel, and flops of the typical branch."""
    from bench.regression.history import read_history

    rows = read_history(folder)
    if rows.empty:
        raise BadResults("the history is empty; add a build to it (try: bench history add)")
    for machine, timed in rows.groupby("machine"):
        newest = timed[timed["commit"].isin(timed["commit"].unique()[-SHOWN:])]
        cells = newest["kernel_steps"].map("{:.3f}".format)
        flops = newest["flops"].map(lambda count: "" if count != count else f" ({count:.0f})")
        table = newest.assign(cell=cells + flops, commit=newest["commit"].str[:10])
        wide = table.pivot_table(index="name", columns="commit", values="cell", aggfunc="last", sort=False)
        title = f"{machine}: steps of the reference kernel a tick (flops), newest build last"
        console().print(frame_table(wide.fillna("").reset_index(), title))
    console().print(counted(rows["commit"].nunique(), "build"))
