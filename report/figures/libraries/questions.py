"""Table of users' questions: cause, cure, and a number without and with the cure, measured while the page is built."""

from __future__ import annotations

from bench.findings.questions import QUESTIONS, Question
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

ASKED = Table("Question | Cause | Cure | Measured | Without the cure:.3g | With it:.3g")


def tables(_: Run) -> dict:
    """Return the table, a row for each question."""
    return {"asked": ASKED(map(describe_question, QUESTIONS))}


def describe_question(one: Question) -> tuple:
    """Return a question's row; what is no more than rounding is 0."""
    links = ", ".join(f"[{thread.partition('/')[2]}]({find_address(thread)})" for thread in one.threads)
    measured = (value if abs(value) > 1e-12 else 0.0 for value in one.measure())
    return f"{one.title} ({links})", one.cause, one.cure, f"{one.quantity}; right: {one.right:g}", *measured


def find_address(thread: str) -> str:
    """Return the address of owner/repository#number; pull requests are found under it too."""
    repository, _, number = thread.partition("#")
    return f"https://github.com/{repository}/issues/{number}"
