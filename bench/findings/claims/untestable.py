"""Sentences of Murphy 1988 that a run cannot decide: what others wrote, or left out."""

from typing import NamedTuple


class Sentence(NamedTuple):
    """Where it stands, the paper's words, and why they are not tested here."""

    section: str
    quote: str
    why: str


UNTESTABLE = (
    Sentence(
        "1",
        "They also showed a stability analysis of the controller by Luh, Walker, and Paul.",
        "it speaks of other works",
    ),
    Sentence(
        "2.3",
        "The controller was proven to be stable for sufficiently small rotational errors",
        "it speaks of other works; C01 tests the controller itself",
    ),
    Sentence(
        "3.0",
        "This Jacobian has been found previously in the literature but without comment on its limitations.",
        "it speaks of other works; C18 tests the limitations",
    ),
    Sentence("3.1", "It is quite common in the robotics literature to define a 6x1 vector", "it speaks of other works"),
    Sentence(
        "3.1", "A small sample of references that use this method", "it speaks of other works, which are not here"
    ),
    Sentence("3.4", "these problems are rarely mentioned in the literature", "it speaks of other works"),
    Sentence(
        "4",
        "This Jacobian is commonly used in the literature without statement to the fact that it must exclude certain "
        "orientations",
        "it speaks of other works; C26 tests the rest of the sentence",
    ),
    Sentence(
        "4",
        "the problem of controlling manipulator orientation in Cartesian space has not been satisfactorily solved",
        "a judgement of 1988; C27 asks what was found since",
    ),
)
