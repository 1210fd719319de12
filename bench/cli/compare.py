"""`compare`: the regression gate."""

from pathlib import Path

import rich_click as click
from click.exceptions import Exit

from bench.cli import options
from bench.cli.screen import console


@click.command("compare")
@click.argument("candidate", type=click.Path(path_type=Path))
@click.argument("reference", required=False, type=click.Path(path_type=Path), default=options.REFERENCE)
def COMMAND(candidate, reference):
    """Compare a run with the reference: outcomes, row keys, schema and operations exactly, floats to a tolerance.

    Exit code 1 and a readable list if they differ.
    """
    from bench.compare import compare

    differences = compare(candidate, reference)
    for line in differences:
        console().print(line, markup=False)
    if differences:
        console().print(f"{len(differences)} differences between {candidate} and {reference}")
        raise Exit(1)
    console().print(f"{candidate} agrees with {reference}")
