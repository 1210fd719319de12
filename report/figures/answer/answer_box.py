"""The box on the front page: the law that is advised, its formula, its page with code, and where another is better."""

from __future__ import annotations

from bench.export.subject import find_subject, subject_words
from bench.findings.selection import needs
from report.figures.kit import families, html
from report.figures.kit.page import Run

SYMBOLS = (
    r"$R_d R^\top$ turns by $\theta$ about $k$; $t$ is its trace and $(\eta, \epsilon) = (\cos\tfrac\theta2, "
    r"\sin\tfrac\theta2\,k)$ its quaternion; $\omega$ and the angular acceleration $u$ are in the base frame."
)
"""What the formulas of laws are written in."""


def answer(run: Run) -> html.Markdown | None:
    """Return the box by what the rule makes of a run."""
    return box(needs.advice(run.folder))


def box(advice: needs.Advice) -> html.Markdown | None:
    """Return formula, exceptions and a link to the code of the advised law; None where no law meets the requirements.

    Of a user's law the exceptions alone: its file is the user's already.
    """
    if advice.default.law is None:
        return None
    if advice.default.law not in subject_words():
        return html.Markdown(exceptions(advice))
    subject = find_subject(advice.default.law)
    parts = (
        f"$$\n{subject.record.formula}\n$$",
        SYMBOLS,
        f"Use another law if one of these applies:\n\n{exceptions(advice)}",
        f"Its code in every language, with test vectors: {_linked(advice.default.law)}.",
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


def _linked(law: str) -> str:
    return families.link(law, families.word(law)).replace('href="../', 'href="', 1)
