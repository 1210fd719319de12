"""What a caller can do wrong, never a contestant's failure: each says what was given, what is allowed, and the cure."""

import difflib
import sys

LISTED = (
    *("regulator", "representation", "jacobian", "inverse"),
    *("task", "arm", "variation", "start", "engine", "suite", "controller", "impedance"),
)
"""Kinds of words that `bench list` has a table of."""


class BenchError(Exception):
    """A mistake of the caller; the command line prints it on one line and exits with 2."""


class UnknownWord(BenchError):
    """A name that is in no list."""

    def __init__(self, kind: str, given: str, known: list[str], meant: str | None = None):
        listed = ", ".join(known) if known else "none"
        near = [meant] if meant else difflib.get_close_matches(given, known, n=1)
        guess = f" (did you mean '{near[0]}'?)" if near else ""
        word = kind.lower()  # "Jacobian" in a sentence, "jacobians" on the command line
        cure = f"try: bench list {word}s" if word in LISTED else "give one of these"
        super().__init__(f"{kind} '{given}' is unknown{guess}; known: {listed} ({cure})")


class BadNumber(BenchError):
    """A number outside its range."""


class BadLaw(BenchError):
    """A law file that cannot be used."""


class BadClaim(BenchError):
    """A claim's file that cannot be used."""


class BadMetric(BenchError):
    """A metric's file that cannot be used."""


class BadModel(BenchError):
    """A robot's file that cannot be loaded, or has no such end effector."""


class BadResults(BenchError):
    """A results folder that cannot be read, written, or continued."""


class NoTable(BadResults):
    """A run has no file of a table."""


class NoEvidence(BenchError):
    """A run has no rows about a question; it decides nothing then, and is never a pass."""


class LostWorkers(BenchError):
    """A cluster that went away, or whose workers did."""


class Incompatible(BenchError):
    """A combination that has no meaning, with the reason."""


class MissingTool(BenchError):
    """Something this machine or environment lacks, with the cure."""


class BadFunction(BenchError):
    """A function that cannot be audited."""


class BadLog(BenchError):
    """A log of actions that cannot be audited."""


def print_refusal(reason: str) -> int:
    """Print what was wrong on one line of stderr and return 2, the exit code of every mistake."""
    shown = "".join(sign if sign.isprintable() else "?" for sign in " ".join(reason.split()))  # of a file, perhaps
    print(f"error: {shown}", file=sys.stderr)
    return 2
