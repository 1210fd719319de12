"""What is said of a law: sentences, and all of them together with the laws beside it."""

from typing import Any, NamedTuple

from bench.findings.subjects import SentenceSubject


class Said(NamedTuple):
    """A sentence, its subject, and the word of the fault that it names; empty if it names none."""

    text: str
    subject: SentenceSubject
    fault: str = ""


class Judgement(NamedTuple):
    """What is said of a law, and a line for it and for each law of results/reference nearest to it (`why.beside`).

    is_lost: it crashed or hung; its rows say where. heading: its name, and the exception that it raises, if it does.
    """

    name: str
    said: tuple[Said, ...]
    beside: tuple[dict[str, Any], ...]
    is_lost: bool
    heading: str = ""

    @property
    def faults(self) -> list[str]:
        """The word of each, once."""
        return list(dict.fromkeys(one.fault for one in self.said if one.fault))
