"""`claims`: the paper's sentences, judged on a run."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import rich_click as click

from bench.cli.paragraphs import Paragraph, print_paragraphs
from bench.cli.progress import progress
from bench.cli.screen import console, examples


@click.command("claims", epilog=examples("claims"))
@click.argument("folder", required=False, type=click.Path(path_type=Path))
@click.option("--criteria", is_flag=True, help="Print each claim's quote and criteria too.")
@click.option(
    "--paper",
    type=click.Choice(("murphy-1988", "lopez-slotine-2024")),
    default="murphy-1988",
    show_default=True,
    help="Whose claims.",
)
def COMMAND(folder: Path | None, criteria: bool, paper: str) -> None:
    """List the claims of Murphy (1988), each with its verdict, measured value and evidence (default: results/latest).

    A claim is judged only if the run has the starts that it needs. The others are at the end, with what is lacking.
    """
    from bench.base.files import read_json
    from bench.experiments.tables.run import WHOLE, Run, shown_folder
    from bench.findings.claims import MURPHY, all_claims, at_gains, judge_possible

    run = Run(folder or shown_folder())
    run.table("episodes")  # refuses a run that has not finished
    with progress("claims", "judging the paper's claims"):
        verdicts, lacks = judge_possible(run, paper)
    for one in verdicts:
        claimed = f"{str(one.word).capitalize()} ({one.rows:,} rows): {one.claim.sentence}"
        correction = (f"What is true: {one.correction}",) if one.correction else ()
        record = _record(one) if criteria else ()
        numbers = (" | ".join(row) for row in one.evidence.numbers)
        replay = (f"Replay: {one.claim.replay}",) if one.claim.replay else ()
        evidence = f"Measured: {one.measured}", *correction, f"Evidence: {one.evidence}", *numbers, *replay
        print_paragraphs(Paragraph(one.id, (claimed, *evidence, *record)))
        console().print()
    if verdicts:
        print_paragraphs(_count(verdicts))
    if paper == MURPHY and at_gains.STORED.is_file():
        study = read_json(at_gains.STORED)
        ids = [one.id for one in all_claims(paper)]
        said = at_gains.describe(study, study["reference"], ids)
        print_paragraphs(Paragraph("Steady?", (f"Of results/reference: {said}",)))
    if lacks:
        reasons = ((id, reason.removesuffix(f": {WHOLE}")) for id, reason in lacks.items())
        texts = (f"{id} cannot be judged from this run: {reason}." for id, reason in reasons)
        print_paragraphs(Paragraph("Not judged", (*texts, f"To judge every claim, {WHOLE}.")))


def _count(verdicts: Sequence[Any]) -> Paragraph:
    """Return how many claims have each word by the present criteria and by the first ones, and which do not hold."""
    from bench.findings.claims import format_tally
    from bench.findings.claims.verdict import Word

    sentences = [f"Of {len(verdicts)} claims {format_tally(verdict.word for verdict in verdicts)}."]
    failed = ", ".join(verdict.id for verdict in verdicts if verdict.word == Word.FAILS)
    if failed:
        sentences.append(f"What does not hold: {failed}.")
    sentences.append(
        f"By the criteria first written: {format_tally(verdict.first for verdict in verdicts)}."
    )
    return Paragraph("In all", tuple(sentences))


def _record(one: Any) -> tuple[str, ...]:
    """Return the paper's words, the criterion, and those before it."""
    claim = one.claim
    before = (f"Before ({old.written}): {old}" for old in claim.earlier)
    return f"Paper, {claim.place}: {claim.quote}", f"Criterion ({claim.written}): {claim.criterion}", *before
