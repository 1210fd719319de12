"""The page of each subject (subjects.toml), and what is wrong with that map; the build refuses a subject without one.

`bench` gives its sentences subjects and knows no page; here the book says where it explains them.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path

from bench.findings.subjects import SentenceSubject, read_pages

REPORT = Path(__file__).resolve().parent
MAP = REPORT / "subjects.toml"


def find_page(subject: SentenceSubject) -> str:
    """Return the name of the page that explains a subject; KeyError if the map has none."""
    return read_pages(MAP)[subject]


def find_pages(subjects: Iterable[SentenceSubject]) -> tuple[str, ...]:
    """Return the pages that explain some subjects, each once, in the order of the subjects."""
    return tuple(dict.fromkeys(map(find_page, subjects)))


def list_pages() -> set[str]:
    """Return the names of the book's pages."""
    return {path.stem for path in REPORT.glob("pages/*.md")}


def find_faults(pages_of: Mapping[str, str], pages: Iterable[str]) -> list[str]:
    """Return what is wrong with a map of subjects to pages, a line each; pages: the names of the book's pages."""
    known = sorted(pages)
    subjects = list(SentenceSubject)
    faults = [
        f"subjects.toml gives the subject '{subject}' no page (cure: add the line {subject} = \"PAGE\", "
        f"PAGE being one of {', '.join(known)})"
        for subject in subjects
        if subject not in pages_of
    ]
    for subject, page in pages_of.items():
        if subject not in subjects:
            faults.append(
                f"subjects.toml has '{subject}', which is no subject of bench/findings/subjects.py "
                "(cure: remove its line, or write the subject there)"
            )
        if page not in known:
            faults.append(
                f"subjects.toml: '{subject}' is on the page '{page}', which the book does not have; "
                f"pages: {', '.join(known)} (cure: name one of these)"
            )
    return faults
