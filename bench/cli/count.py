"""`count`: operations a tick, from the code that runs."""

import pandas as pd
import rich_click as click

from bench.cli import options
from bench.cli.screen import console, frame_table


@click.command("count")
@options.law
@options.regulator
@options.representation
@click.option("--stages", is_flag=True, help="A line for each stage of the tick, not only the total.")
def COMMAND(laws, regulators, representations, stages):
    """Count the operations of each law per tick: typical and worst branch, transcendental functions apart."""
    from bench import counting

    table = pd.DataFrame(counting.rows(options.chosen(laws, regulators, representations, costings=True)))
    if not stages:
        table = table[table["stage"] == "total"].drop(columns="stage")
    table = table.drop(columns=["jacobian", "inverse"])
    console().print(frame_table(table.loc[:, (table != 0).any()], "Operations per tick"))
