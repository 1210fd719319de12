"""`claims`: the paper's sentences, judged on a run."""

from pathlib import Path

import rich_click as click

from bench.cli.paragraphs import Paragraph, print_paragraphs
from bench.cli.progress import progress
from bench.cli.screen import console


@click.command("claims")
@click.argument("folder", required=False, type=click.Path(path_type=Path))
@click.option("--criteria", is_flag=True, help="Print each claim's criterion too.")
def COMMAND(folder, criteria):
    """The claims of Murphy (1988): id, verdict, what is claimed, then the evidence (default: results/latest)."""
    from bench.findings.claims import judge_all
    from bench.tables import read

    with progress("claims", "judging the paper's claims"):
        verdicts = judge_all(folder or read.folder())
    for one in verdicts:
        claimed = f"{str(one.word).capitalize()} ({one.rows:,} rows): {one.claim.sentence}"
        criterion = (f"Criterion: {one.claim.criterion}",) if criteria else ()
        print_paragraphs(Paragraph(one.id, (claimed, f"Evidence: {one.evidence}", *criterion)))
        console().print()
