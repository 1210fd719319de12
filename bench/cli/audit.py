"""`audit`: the orientation error that a controller has."""

import json
from pathlib import Path
from typing import Any

import rich_click as click
from click.exceptions import Exit

from bench.audit.apart import CALLS, LIMIT_S, NotAudited, audit_apart
from bench.base.errors import BadFunction
from bench.cli.progress import progress
from bench.cli.screen import examples


@click.command("audit", epilog=examples("audit"))
@click.argument("function", metavar="FUNCTION")
@click.option("--takes", metavar="WORD", help="What it takes: matrix, wxyz or xyzw; found if left out.")
@click.option("--frame", metavar="WORD", help="The frame that it must be in: base or body.")
@click.option("--sign", metavar="WORD", help="Where it must point: to-goal or from-goal.")
@click.option("--stiffness", type=float, default=1.0, show_default=True, help="Slope that your gains reckon with.")
@click.option("--accept", multiple=True, metavar="FAULT", help="A fault that is meant; repeatable.")
@click.option("--limit", type=click.FloatRange(0.1), default=LIMIT_S, show_default=True, help="Seconds it may take.")
@click.option("--json", "json_file", type=click.Path(path_type=Path), metavar="FILE", help="All of it for machines.")
def COMMAND(function: str, limit: float, json_file: Path | None, **stated: Any) -> None:
    """Check an orientation error of yours: its convention, and what is wrong with it, each with a pair to reproduce.

    FUNCTION is FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL. It takes (R, R_d), 3 x 3, or (q, q_d), and returns three
    numbers. Which frame, direction, form and order of quaternions it has is found, and said. It is called with some
    thousand pairs of orientations, in a process of its own that has a time limit and whose output is dropped: a second.
    """
    try:
        with progress("calls", f"loading {function}") as steps:
            said = audit_apart(function, stated, limit, lambda calls: steps.now(f"calling {function}", calls, CALLS))
    except NotAudited as error:
        raise BadFunction(str(error)) from error
    click.echo(said["text"], nl=False)
    if json_file:
        json_file.write_text(json.dumps(said["report"], indent=1, allow_nan=False) + "\n", encoding="utf-8")
    if said["report"]["faults"]:
        raise Exit(1)
