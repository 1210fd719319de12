"""The box on the front page: the law that is advised, its formula, its code to copy, and where another is better."""

from __future__ import annotations

from bench.export.language import find_language
from bench.export.subject import Subject, find_subject, subject_words
from bench.findings.selection import needs
from report.figures.kit import families, html
from report.figures.kit.page import Run

COPIED = {"python": "Python", "cpp": "C++", "c": "C"}
"""Languages whose file can be copied, with the head of their tab."""

SYMBOLS = (
    r"$R_d R^\top$ turns by $\theta$ about $k$; $t$ is its trace and $(\eta, \epsilon) = (\cos\tfrac\theta2, "
    r"\sin\tfrac\theta2\,k)$ its quaternion; $\omega$ and the angular acceleration $u$ are in the base frame."
)
"""What the formulas of laws are written in."""


def answer(run: Run) -> html.Markdown | None:
    """Return the box by what the rule makes of a run."""
    return box(needs.advice(run.folder))


def box(advice: needs.Advice) -> html.Markdown | None:
    """Return formula, exceptions and code of the advised law; None where no law meets the requirements.

    Of a user's law the exceptions alone: its file is the user's already.
    """
    if advice.default.law is None:
        return None
    if advice.default.law not in subject_words():
        return html.Markdown(exceptions(advice))
    subject = find_subject(advice.default.law)
    tabs = "\n".join(_tab(title, word, subject) for word, title in COPIED.items())
    parts = (
        f"$$\n{subject.record.formula}\n$$",
        SYMBOLS,
        f"Use another law if one of these applies:\n\n{exceptions(advice)}",
        f"`````{{tab-set}}\n{tabs}\n`````",
    )
    return html.Markdown("\n\n".join(parts))


def exceptions(advice: needs.Advice) -> str:
    """For each other law the situations in which it is better, as a list."""
    situations: dict[str, list[str]] = {}
    for one in advice.exceptions:
        if one.law:
            situations.setdefault(one.law, []).append(one.need.words)
    lines = [f"- {_linked(law)}: {'; '.join(words)}" for law, words in situations.items()]
    return "\n".join(lines)


def _tab(title: str, word: str, subject: Subject) -> str:
    """Return the law's file, the first of an export, as a tab of plain text: colours would be most of the page."""
    text = find_language(word).law(subject)[1]
    return f"````{{tab-item}} {title}\n```text\n{text}```\n````"


def _linked(law: str) -> str:
    return families.link(law, families.word(law)).replace('href="../', 'href="', 1)
