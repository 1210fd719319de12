"""`trust`: say that a law file of somebody else may run when results are read."""

from pathlib import Path

import rich_click as click

from bench.base.errors import BadLaw
from bench.cli.screen import console, shown_path
from bench.experiments.tables import trust


@click.command("trust")
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
def COMMAND(files: tuple[Path, ...]) -> None:
    """Let these law files run when a results folder that holds them is read, as your own do. Read them first.

    A law is Python: it can do all that you can. Without this, a law in a folder from elsewhere is shown by its rows,
    with its file as text. What is trusted is the text as it is now, wherever it lies; one changed sign makes another.
    """
    for path in files:
        try:
            trust.remember(path.read_bytes())
        except OSError as error:
            raise BadLaw(
                f"{path}: it cannot be trusted ({error.strerror}: {error.filename}); check the file"
            ) from error
        console().print(f"trusted: {shown_path(path)}")
