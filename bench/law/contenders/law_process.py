"""One question about a user's law, answered in a process of its own (bench/base/isolated.py)."""

import json
from collections.abc import Callable
from pathlib import Path

from bench.base.errors import BadLaw, BenchError
from bench.base.isolated import FORGED, IsolatedProcess, Line, NoAnswer, Refused, TimeLimits, serve
from bench.law.contenders.law_file import keep_text

CONFUSED = "its process did not give back an answer; correct what runs on import"


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
    try:
        with IsolatedProcess(module) as process:
            return dict(json.loads(process.ask(question, limits)))
    except Refused as mistake:
        raise BadLaw(str(mistake)) from mistake
    except NoAnswer as error:
        what = CONFUSED if error.fate == FORGED else f"{error}; correct the file"
        raise BadLaw(f"--law {files}: {what}") from error
    except (ValueError, TypeError, RecursionError) as error:
        raise BadLaw(f"--law {files}: {CONFUSED}") from error


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
