"""Why a law has no proof: it is not of a theorem's form, its source cannot be traced, a lemma fails, or time is up."""

import math
import signal
import time
import traceback
from pathlib import Path
from typing import Any

LOOKS_AGAIN_S = 1.0
"""Seconds of processor time after which a law whose time is over is interrupted again."""
OURS = str(Path(__file__).parent)
"""The prover's own files are here: a reason names a line of the law, and no line of these."""


class DoesNotFit(Exception):
    """A law that is not of a theorem's form; the reason is its text."""


class Untraceable(DoesNotFit):
    """A law whose source cannot be called with symbols; the reason is its text."""


class LemmaFails(DoesNotFit):
    """A law for which a lemma that comes before all others fails; `lemmas` has it, and those that hold."""

    def __init__(self, lemmas: list[Any]) -> None:
        failed = [lemma.statement for lemma in lemmas if not lemma.is_proved]
        super().__init__("; ".join(failed))
        self.lemmas = lemmas


class TimeIsUp(BaseException):
    """The time for a law is over. It is no Exception, so that nothing that handles errors keeps it."""


class ProofLimits:
    """How long the prover may take.

    Attributes:
        question_s: Seconds that Z3 may take for one question.
        ends: When the time for this law is over, in seconds of processor time; infinity without a limit.
        lemmas: What is decided already: it is reported if the time is over.
        asked: The statement that is being decided.
    """

    def __init__(self) -> None:
        self.question_s = 30.0
        self.ends = math.inf
        self.lemmas: list[Any] = []
        self.asked = ""

    def begin(self, question_s: float, law_s: float) -> None:
        """Start the clock of a law. When it is over, TimeIsUp is raised wherever Python is: in algebra, too.

        It is raised again after each further second until `stop`, for a destructor would lose it.
        """
        self.question_s = question_s
        self.ends = time.process_time() + law_s
        signal.signal(signal.SIGPROF, self._look)
        signal.setitimer(signal.ITIMER_PROF, law_s, LOOKS_AGAIN_S)

    def stop(self) -> None:
        """Stop the clock: what follows is no part of a law's time."""
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        self.ends = math.inf

    def _look(self, *_: Any) -> None:
        self.left_s()

    def left_s(self) -> float:
        """Return the seconds left for this law; TimeIsUp: none."""
        left = self.ends - time.process_time()
        if left <= 0.0:
            raise TimeIsUp
        return left


LIMITS = ProofLimits()
"""The limits of this process, which proves one law at a time."""


def describe_error(error: BaseException) -> str:
    """Return an error's type, the last line that it passed outside the prover, and its text."""
    place = ""
    for frame in traceback.extract_tb(error.__traceback__):
        if is_of_a_law(frame.filename):
            place = f" in {Path(frame.filename).name}, line {frame.lineno}"
    return f"{type(error).__name__}{place}: {error}"


def is_of_a_law(file: str) -> bool:
    """Tell whether a file may hold a law: it is not the prover's, no library's, and not made of text at run time."""
    return not (file.startswith((OURS, "<")) or "site-packages" in file or "/lib/python" in file)
