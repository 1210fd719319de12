"""What `show --details` says in sentences: the advice in full and what failed before its tables, the claims after."""

from pathlib import Path

from bench.cli.paragraphs import Paragraph, print_paragraphs
from bench.cli.progress import progress
from bench.cli.summary import answer, failures
from bench.cli.summary.paper import holds_papers_laws
from bench.findings.claims import Results, judge_possible, told
from bench.findings.claims.verdict import NoEvidence, Word
from bench.findings.kept import keep
from bench.findings.selection.needs import measure


def print_sentences(folder: Path) -> None:
    """Print the advice with its set and bounds, how laws compare in the run, and what failed part by part."""
    results = Results(folder)
    results.table("episodes")  # refuses a run that has not finished
    said = keep(folder, "answer", lambda: _find_answer(results))["said"]
    print_paragraphs(*(Paragraph(head, tuple(sentences)) for head, sentences in said), failures.paragraph(results))


def print_claims(folder: Path) -> None:
    """Print how many claims have each word by the present criteria and by the first ones, and which do not hold."""
    results = Results(folder)
    if not holds_papers_laws(results):
        return
    with progress("claims", "judging the paper's claims"):
        decided, lacks = judge_possible(results)
    now = f"Of the paper's {len(decided) + len(lacks)} claims {told(verdict.word for verdict in decided)}."
    failed = ", ".join(verdict.id for verdict in decided if verdict.word == Word.FAILS)
    first = f"By the criteria first written: {told(verdict.first for verdict in decided)}."
    sentences = [now, *([f"What does not hold: {failed}."] if failed else []), first]
    if lacks:
        sentences.append(f"{len(lacks)} cannot be judged from this run (why: bench claims).")
    print_paragraphs(Paragraph("Claims", tuple(sentences)))


def _find_answer(results: Results) -> dict:
    """Return the heads and sentences of the answer, as JSON holds them."""
    try:
        return {"said": answer.paragraphs(measure(results))}
    except NoEvidence:
        return {"said": answer.paragraphs(None)}
