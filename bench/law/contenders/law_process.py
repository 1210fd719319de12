"""One question about a user's law, answered in a process of its own (bench/base/isolated.py)."""

import contextlib
import json
from collections.abc import Callable, Iterator
from pathlib import Path

from bench.base.errors import BadLaw, BenchError
from bench.base.isolated import FORGED, IsolatedProcess, Line, NoAnswer, Refused, TimeLimits
from bench.base.serving import serve
from bench.law.contenders.law_file import keep_text


@contextlib.contextmanager
def bad_law(files: str, why: str, duty: str) -> Iterator[None]:
    """Raise BadLaw in place of an error of a request to a law's process.

    Args:
        files: The laws'.
        why: What is said if there is no answer, with {} for the reason.
        duty: What the process did not do if its answer is none.
    """
    try:
        yield
    except Refused as mistake:
        raise BadLaw(str(mistake)) from mistake
    except (NoAnswer, LookupError, TypeError, AttributeError, ValueError, RecursionError) as error:
        what = f"its process did not {duty}; correct what runs on import"
        if isinstance(error, NoAnswer) and error.fate != FORGED:
            what = why.format(error)
        raise BadLaw(f"--law {files}: {what}") from error


def ask(module: str, question: dict, limits: TimeLimits, files: str) -> dict:
    """Return what a process of a module of ours answers, an object of JSON.

    Args:
        module: It calls `answer`.
        question: Has the law's `text`, if it is a user's, and its `origin`, the user's file.
        limits: Of the answer.
        files: The laws', for errors.

    Errors:
        BadLaw: A mistake that the process names, or it did not return, ended, or gave no answer.
    """
    why = "{}; correct the file"
    with bad_law(files, why, "give back an answer"), IsolatedProcess(module) as process:
        return dict(json.loads(process.ask(question, limits)))


def answer(make: Callable[[dict, Path | None], dict]) -> None:
    """Answer in a law's own process; a mistake of the caller names the user's own file.

    make: of the question and the file that holds the law's text, if there is one.
    """

    def answer_question(question: dict, _: Line) -> bytes:
        path = keep_text(question["text"]) if question["text"] else None
        try:
            return json.dumps(make(question, path)).encode()
        except BenchError as error:
            raise Refused(str(error).replace(str(path), question["origin"])) from error

    serve(answer_question)
