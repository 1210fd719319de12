"""What a question is, and what is found of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench import questions
from bench.errors import UnknownWord
from tasks.discovery import constants


class Curves(NamedTuple):
    """One quantity over a range (n), as it was asked about and with the cure."""

    x: np.ndarray
    before: np.ndarray
    after: np.ndarray


class Question(NamedTuple):
    """A public thread as a case that runs.

    threads: owner/repository#number, the one that was read first. asked: what its authors saw, in our words. cause,
    cure: a sentence or two. x, y: what the axes of the curves are, with units; right, tolerance: the value of y where
    nothing is wrong, and how far from it that still is so. curves() -> Curves.
    """

    name: str
    title: str
    threads: tuple[str, ...]
    asked: str
    cause: str
    cure: str
    x: str
    y: str
    curves: Callable[[], Curves]
    right: float = 0.0
    tolerance: float = 0.0
    is_log_x: bool = False
    is_log_y: bool = False


class Found(NamedTuple):
    """Of y the value that is furthest from right, as it was asked about and with the cure, and where that is (x)."""

    symptom: float
    at: float
    cured: float
    shows: bool
    cures: bool


def find(question: Question, curves: Curves | None = None) -> Found:
    """What a question's curves say: whether the symptom shows, and whether the cure cures it."""
    curves = curves or question.curves()
    off = [np.abs(values - question.right) for values in curves[1:]]
    worst, left = (int(np.argmax(each)) for each in off)
    return Found(
        float(curves.before[worst]),
        float(curves.x[worst]),
        float(curves.after[left]),
        bool(off[0][worst] > question.tolerance),
        bool(off[1][left] <= question.tolerance),
    )


def every_question() -> dict[str, Question]:
    """All questions, by name."""
    return constants(questions, "QUESTION")


def question(name: str) -> Question:
    """The question of that name.

    Errors:
        UnknownWord: there is none.
    """
    known = every_question()
    if name not in known:
        raise UnknownWord("question", name, sorted(known))
    return known[name]
