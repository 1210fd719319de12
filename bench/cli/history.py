"""`history`: measure this commit, and add what it costs to the measured builds."""

from pathlib import Path

import rich_click as click

from bench.cli.screen import console, examples
from bench.experiments.tables.schema import RESULTS


@click.command("history", epilog=examples("history"))
@click.option(
    "--folder",
    type=click.Path(path_type=Path),
    default=RESULTS / "history",
    show_default="results/history",
    metavar="FOLDER",
    help="The history.",
)
def COMMAND(folder: Path) -> None:
    """Time each law and some engines of this commit, count operations, and add a file to the history.

    The book draws the history: the time of a tick in steps of the reference kernel, and flops of the typical branch.
    """
    from bench.regression.history import append_build

    with console(stderr=True).status("compiling and timing: some minutes"):
        path = append_build(folder)
    console().print(f"added: {path}")
