"""The whole summary: the answer first, as soon as it is known, for the claims may take seconds."""

import os
from pathlib import Path

from bench.cli.details import PARTS
from bench.cli.options import REFERENCE
from bench.cli.paragraphs import Paragraph, listed, origin, print_paragraphs
from bench.cli.progress import progress
from bench.cli.screen import counted, shown_path
from bench.cli.summary import answer, failures
from bench.experiments.tables import read as results
from bench.findings.claims import Results, judge_possible, told
from bench.findings.claims.verdict import NoEvidence, Word
from bench.findings.kept import keep
from bench.findings.selection.needs import measure
from bench.law.contenders.registry import all_contenders


def print_summary(folder: Path, is_named: bool) -> None:
    """Print it. `is_named`: whether the user named the folder, so that the commands below name it too."""
    found = Results(folder)
    found.table("episodes")  # refuses a run that has not finished
    here: tuple[str, ...] = (origin(folder),)
    if not is_named and folder == REFERENCE and results.VARIABLE not in os.environ:
        here += ("It came with the benchmark; results/latest has no finished run (try: make bench).",)
    said = keep(folder, "answer", lambda: _answer(found))["said"]
    print_paragraphs(*(Paragraph(head, tuple(sentences)) for head, sentences in said))
    with progress("claims", "judging the paper's claims"):
        judged = count_verdicts(found)
    print_paragraphs(
        judged,
        failures.paragraph(found),
        *list_absent(found),
        Paragraph("This run", here),
        _next(folder, is_named, parts_in(found)),
    )


def _answer(found: Results) -> dict:
    """Return the heads and sentences of the answer, as JSON holds them."""
    try:
        return {"said": answer.paragraphs(measure(found))}
    except NoEvidence:
        return {"said": answer.paragraphs(None)}


def _next(folder: Path, is_named: bool, present: list[str]) -> Paragraph:
    here = shown_path(folder)
    show = f"bench show {here}" if is_named else "bench show"
    book = f"{results.VARIABLE}={here} make report" if is_named else "make report"
    parts = f", or one part: {', '.join(present)}" if len(present) > 1 else ""
    claims = f"bench claims {here}   each claim with its evidence"
    return Paragraph("Next", (f"{book}   the book of this run", f"{show} --details   every table{parts}", claims))


def count_verdicts(results: Results) -> Paragraph:
    """How many claims got each word, by the present criteria and by the first ones; which do not hold."""
    decided, lacks = judge_possible(results)
    every = len(decided) + len(lacks)
    if not decided:
        return Paragraph("Claims", (f"None of the paper's {every} claims can be judged from this run.",))
    failed = ", ".join(one.id for one in decided if one.word == Word.FAILS)
    alone = sum(one.evidence.tables == ("experiment",) for one in decided)
    computed = f" ({alone} by computations that need no starts of a run)" if lacks and alone else ""
    now = f"Of the paper's {every} claims {told(one.word for one in decided)}{computed}"
    now += f". What does not hold: {failed}" if failed else ""
    unknown = f"; {len(lacks)} cannot be judged from this run" if lacks else ""
    first = told(one.first for one in decided)
    return Paragraph("Claims", (f"{now}{unknown}. By the criteria first written: {first}.",))


def parts_in(results: Results) -> list[str]:
    """Return the parts of a run, as `show` names them, that have rows."""
    episodes = results.table("episodes")
    has = {"free-body": (episodes["arm"] == "").any(), "arms": (episodes["arm"] != "").any()}
    has |= {"contact": len(results.table("compliance")), "robustness": len(results.table("robustness"))}
    return [part for part in PARTS if has[part]]


def list_absent(results: Results) -> list[Paragraph]:
    """Return the parts and the laws that are not in the run; nothing if all are."""
    episodes = results.table("episodes")
    present = parts_in(results)
    absent = [part.replace("-", " ") for part in PARTS if part not in present]
    ran = {str(name).partition("@")[0] for name in episodes["contender"].unique()}
    laws = [one.name for one in all_contenders() if not one.regulator.costing_only]
    missing = [law for law in laws if law not in ran]
    if "free-body" in present and missing:
        absent.append(f"{len(missing)} of the benchmark's {counted(len(laws), 'law')}")
    return [Paragraph("Not in it", (f"Not in this run: {listed(absent)}.",))] if absent else []
