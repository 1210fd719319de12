"""The paper about the software: text of paper.md, numbers of the published results."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from string import Template

TEXT = Path(__file__).with_name("paper.md")
BIBLIOGRAPHY = Path(__file__).resolve().parents[1] / "references.bib"


def written(folder: Path) -> str:
    """A paper for a software journal, with its numbers and bibliography."""
    text = Template(TEXT.read_text(encoding="utf-8")).substitute(numbers())
    (folder / "paper.md").write_text(text, encoding="utf-8")
    shutil.copyfile(BIBLIOGRAPHY, folder / "paper.bib")
    return f"{len(text.split())} words"


def cited() -> set[str]:
    """Keys of the bibliography that the text names."""
    return set(re.findall(r"@([a-z]+\d{4}[a-z]?)", TEXT.read_text(encoding="utf-8")))


def numbers() -> dict[str, object]:
    """What the text's placeholders stand for."""
    from bench.findings import claims
    from bench.findings.counts import counts
    from bench.tables import read
    from report.figures import index
    from report.figures.answer import which_law
    from report.figures.kit.page import run_in
    from report.figures.libraries import libraries

    run = run_in(read.folder())
    words = [one.word for one in claims.judge_all()]
    found = libraries.facts(run)
    return {
        **index.of_the_paper(run),
        "date": read.provenance()["finished"].partition("T")[0],
        "laws": counts()["laws"].number,
        "arms": counts()["arms"].number,
        "claims": len(words),
        "words": claims.told(words),
        "asked": found["functions"],
        "faulty": found["functions"] - found["right"],
        "which_law": which_law.front_page(run),
    }
