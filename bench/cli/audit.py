"""`audit`: the orientation error that a controller has."""

import json
from pathlib import Path

import rich_click as click
from click.exceptions import Exit

from bench.cli.screen import examples

EPILOG = examples(
    ("A function of two matrices or two quaternions", "audit my_file.py:my_error"),
    ("One of C: void f(const double[9], const double[9], double[3])", "audit libmine.so:my_error"),
    ("A class whose instance is called", "audit my_controller.py:Controller"),
    ("It must be in base, and a clip is meant", "audit my.py:f --frame base --accept norm-clip"),
    after="A fault is what no controller wants. A note is a property that one may want, as the sine's zero at "
    "180°, or what no encoder shows. In pytest: pytest --orientation-error my_file.py:my_error\n"
    "Exit code 1: a fault that is not accepted. 2: no report, as of a file that holds no such function.",
)


@click.command("audit", epilog=EPILOG)
@click.argument("function", metavar="FUNCTION")
@click.option("--takes", metavar="WORD", help="What it takes: matrix, wxyz or xyzw; found if left out.")
@click.option("--frame", metavar="WORD", help="The frame that it must be in: base or body.")
@click.option("--sign", metavar="WORD", help="Where it must point: to-goal or from-goal.")
@click.option("--stiffness", type=float, default=1.0, show_default=True, help="Slope that your gains reckon with.")
@click.option("--accept", multiple=True, metavar="FAULT", help="A fault that is meant; repeatable.")
@click.option("--json", "json_file", type=click.Path(path_type=Path), metavar="FILE", help="All of it for machines.")
def COMMAND(function: str, takes, frame, sign, stiffness, accept, json_file: Path | None):
    """Check an orientation error of yours: its convention, and what is wrong with it, each with a pair to reproduce.

    FUNCTION is FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL. It takes (R, R_d), 3 x 3, or (q, q_d), and returns three
    numbers. Which frame, direction, form and order of quaternions it has is found, and said. It is asked over some
    thousand pairs of orientations in this process: a second.
    """
    from bench.audit import audit
    from bench.audit.load import load

    report = audit(load(function), takes, frame=frame, sign=sign, stiffness=stiffness, accept=accept, name=function)
    click.echo(report.text(), nl=False)
    if json_file:
        json_file.write_text(json.dumps(report.as_dict(), indent=1, allow_nan=False) + "\n", encoding="utf-8")
    if report.faults:
        raise Exit(1)
