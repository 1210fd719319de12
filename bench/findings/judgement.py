"""Records of a judgement: its sentences, and the laws that are nearest to the law."""

from typing import Any, NamedTuple

from bench.findings.subjects import SentenceSubject


class Sentence(NamedTuple):
    """A sentence, its subject, and the word of the fault that it names; empty if it names none."""

    text: str
    subject: SentenceSubject
    fault: str = ""


class Judgement(NamedTuple):
    """The judgement of a law.

    Attributes:
        name: Name of the law.
        sentences: What its rows say of it.
        beside: A line for it and for each law of results/reference nearest to it (`why.beside`).
        is_lost: Whether it crashed or hung; its rows say where.
        heading: Its name, and the exception that it raises, if it does.
    """

    name: str
    sentences: tuple[Sentence, ...]
    beside: tuple[dict[str, Any], ...]
    is_lost: bool
    heading: str = ""

    @property
    def faults(self) -> list[str]:
        """The word of each fault, once."""
        return list(dict.fromkeys(sentence.fault for sentence in self.sentences if sentence.fault))
