"""The box on the front page: the law that is advised, its formula, its page with code, and what leads to another."""

from __future__ import annotations

from bench.export.subject import find_subject
from bench.findings.selection.regions import find_default
from bench.findings.selection.robots import list_elsewhere
from report.figures.kit import families, html
from report.figures.kit.page import Run

SYMBOLS = (
    r"$R_d R^\top$ turns by $\theta$ about $k$; $t$ is its trace and $(\eta, \epsilon) = (\cos\tfrac\theta2, "
    r"\sin\tfrac\theta2\,k)$ its quaternion; $\omega$ and the angular acceleration $u$ are in the base frame."
)
"""What the formulas of laws are written in."""


def answer(run: Run) -> html.Markdown:
    """Return the advised law's formula, the laws for other needs, and a link to its code."""
    law = find_default()
    parts = (
        f"$$\n{find_subject(law).record.formula}\n$$",
        SYMBOLS,
        f"Use another law if one of these applies:\n\n{exceptions(run, law)}",
        f"Its code in every language, with test vectors: {_linked(law)}.",
    )
    return html.Markdown("\n\n".join(parts))


def exceptions(run: Run, default: str) -> str:
    """For each other law what leads to it, as a list."""
    needs: dict[str, list[str]] = {}
    for one in list_elsewhere(run.folder):
        needs.setdefault(one.law, []).append(one.words)
    lines = [f"- {_linked(law)}: {'; '.join(words)}" for law, words in needs.items() if law != default]
    return "\n".join(lines)


def _linked(law: str) -> str:
    return families.link(law, families.word(law)).replace('href="../', 'href="', 1)
