"""What `show --details` says in sentences: the advice in full, and what failed, before its tables."""

from pathlib import Path

from bench.base.errors import NoEvidence
from bench.cli.paragraphs import Paragraph, print_paragraphs
from bench.cli.summary import answer, failures
from bench.experiments.tables.run import Run
from bench.findings.kept import keep
from bench.findings.selection.run_rows import compare_free_body


def print_sentences(folder: Path) -> None:
    """Print the advice with its set and bounds, how laws compare in the run, and what failed part by part."""
    run = Run(folder)
    run.table("episodes")  # refuses a run that has not finished
    said = keep(folder, "answer", lambda: _find_answer(run))["said"]
    print_paragraphs(
        *(Paragraph(head, tuple(sentences)) for head, sentences in said),
        failures.paragraph(run),
    )


def _find_answer(run: Run) -> dict:
    """Return the heads and sentences of the answer, as JSON holds them."""
    try:
        return {"said": answer.paragraphs(compare_free_body(run))}
    except NoEvidence:
        return {"said": answer.paragraphs(None)}
