"""The page on exported laws: languages, entries, and how many subjects there are."""

from __future__ import annotations

from bench.export.language import find_language, language_words
from bench.export.subject import find_subject, subject_words
from bench.export.vectors import CLOSE, vectors
from bench.law.contenders.registry import all_contenders, contenders, papers_laws
from report.figures.kit.page import Run
from report.figures.kit.spelling import listed
from report.figures.kit.tables import Table

LANGUAGES = Table("Language | `--to` | The law | Try it")
ENTRIES = Table("Entry | Gives")
SHOWN = papers_laws()[0].name
"""The law whose files and entries are listed: it has no memory."""


def facts(run: Run) -> dict:
    """How many languages, vectors and subjects there are."""
    words = [find_language(word).title for word in language_words()]
    laws, coordinates = len(all_contenders()), len(contenders("representations"))
    return {
        "languages": listed(words),
        "vectors": len(vectors(find_subject(SHOWN))),
        "close": f"{CLOSE:g}",
        "subjects": len(subject_words()),
        "laws": laws,
        "coordinates": coordinates,
        "impedances": len(subject_words()) - laws - coordinates,
    }


def tables(run: Run) -> dict:
    """Languages with their commands; the entries of a law."""
    subject = find_subject(SHOWN)
    name = subject.identifier
    lines = []
    for word in language_words():
        one = find_language(word)
        files = [file for file in one.files(subject) if file not in ("vectors.json", "README.md")]
        lines.append(
            (one.title, f"`{word}`", ", ".join(f"`{file}`" for file in files), f"`{one.test.format(name=name)}`")
        )
    plain = (one for one in subject.entries if not one.name.endswith("_body"))
    named = {"gains": "kp, kv"}
    entries = [
        (f"`{one.name}({', '.join(named.get(each.name, each.name) for each in one.parameters)})`", one.doc)
        for one in plain
    ]
    return {"tab_languages": LANGUAGES(lines), "tab_entries": ENTRIES(entries)}
