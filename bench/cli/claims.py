"""`claims`: the paper's sentences, judged on a run."""

from pathlib import Path

import rich_click as click

from bench.cli.screen import console
from bench.tables import read


@click.command("claims")
@click.argument("folder", required=False, type=click.Path(path_type=Path))
@click.option("--criteria", is_flag=True, help="Print each claim's criterion below it.")
def COMMAND(folder, criteria):
    """The claims of Murphy (1988), one line each: id, verdict, evidence, rows (default: results/latest)."""
    from bench.findings.claims import judge_all

    folder = folder or read.folder()
    for verdict in judge_all(folder):
        console().print(f"{verdict.id}  {verdict.word}: {verdict.evidence} ({verdict.rows:,} rows)", soft_wrap=True)
        if criteria:
            console().print(f"     criterion: {verdict.claim.criterion}", soft_wrap=True)
