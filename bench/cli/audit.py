"""`audit`: the command line of the audit, as it is without the benchmark."""

import rich_click as click
from click.exceptions import Exit

from bench.audit.command import run_command
from bench.base.provenance import describe_project


@click.command("audit", add_help_option=False, context_settings={"ignore_unknown_options": True})
@click.argument("command", nargs=-1, type=click.UNPROCESSED)
def COMMAND(command: tuple[str, ...]) -> None:
    """Check an orientation error of yours: its convention, and what is wrong with it, each with a pair to reproduce."""
    if code := run_command(command, "bench audit", describe_project()["version"]):
        raise Exit(code)
