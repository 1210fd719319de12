"""What a user's file says of its law, without the law: read by a process of its own, known by plain words.

    described(path) -> a Law whose functions are in the sandbox alone

This module is that process too (bench/base/isolated.py). It answers two requests: the path and the
text, with the words of the law; then another, when the law has answered once.
"""

import base64
import contextlib
import functools
import json
from pathlib import Path
from typing import Any

from bench.base.isolated import IsolatedProcess, Line, NoAnswer, TimeLimits
from bench.base.serving import serve
from bench.law.contenders.law_file import check_answers, check_fields, load_law, read_law
from bench.law.contenders.law_process import bad_law
from bench.law.display import Display, Look
from bench.law.kinds import Law, OnCoordinates, UserFile

LOAD_S, WAITS_S = 20.0, 60.0
"""Limits for a user's file to import: seconds of processor time, and on the wall, for a file that
waits or is kept waiting by a busy machine."""

TRIAL_LIMITS = TimeLimits(processor_s=5.0, wall_s=10.0)
"""Limits for its law to be called once."""

FUNCTIONS = ("law", "law_in", "margin", "coordinate_law_in")
ELSEWHERE = ("file", "display", "attribution")
"""Fields that say nothing of a user's law, or that only its own process needs."""


def described(path: Path, text: bytes | None = None, limit_s: float = LOAD_S, waits_s: float = WAITS_S) -> Law:
    """Return the law of a file, or of its text, by its words: its functions refuse to be called here.

    Errors:
        BadLaw: the file is missing, does not import, ends its process or does not return, or holds no law.
    """
    path = Path(path)
    if text is None:
        text = read_law(path)
    why = "it does not load ({}); correct what runs on import"
    with bad_law(str(path), why, "say what it is"):
        file = UserFile(str(path), text.decode())
        law = stand_in(_described(path, text, limit_s, waits_s), file)
        check_fields(law, path)
    return law


@functools.lru_cache(maxsize=32)
def _described(path: Path, text: bytes, limit_s: float, waits_s: float) -> str:
    """Return the fields as JSON; once for the same text."""
    request = {"path": str(path), "text": base64.b64encode(text).decode()}
    trial = TimeLimits(min(TRIAL_LIMITS.processor_s, limit_s), min(TRIAL_LIMITS.wall_s, waits_s))
    with IsolatedProcess(__name__) as process:
        fields = process.ask(request, TimeLimits(limit_s, waits_s))
        # A law that crashes or hangs here is known all the same: its rows will say so.
        with contextlib.suppress(NoAnswer):
            process.ask({}, trial)
    return fields.decode(errors="replace")


def stand_in(content: str, file: UserFile) -> Law:
    """Return the Law that these fields describe, of this file."""
    fields: dict[str, Any] = json.loads(content)
    given: dict[str, Any] = dict.fromkeys(fields.pop("functions"), not_here)
    given |= {name: tuple(value) if isinstance(value, list) else value for name, value in fields.items()}
    look = given.pop("look")
    display = Display(given.pop("short"), look and Look(*look), given.pop("family"))
    on_coordinates = {name: given.pop(name) for name in OnCoordinates._fields if name in given}
    if on_coordinates:
        given["law"] = OnCoordinates(**on_coordinates)
    return Law(**given, display=display, file=file)


def fields_of(own: Law) -> dict[str, Any]:
    """Return the words of a law, as JSON takes them."""
    every = own._asdict() | (own.law._asdict() if isinstance(own.law, OnCoordinates) else {})
    words = {name: value for name, value in every.items() if name not in (*FUNCTIONS, *ELSEWHERE)}
    shown = {name: getattr(own.display, name) for name in ("short", "look", "family")}
    return {**words, **shown, "functions": [name for name in FUNCTIONS if callable(every.get(name))]}


def not_here(*_):
    """Stand for each function of a user's law, and refuse to be called."""
    raise RuntimeError("a user's law is called in its sandbox alone")


class LawReader:
    """Reads a user's file in its own process.

    Attributes:
        law: The law of the file, once it was read.
    """

    law: Law

    def answer(self, request: dict, _: Line) -> bytes:
        """Load the file that is given, and return the words of its law; then call the law once."""
        if "text" in request:
            self.law = load_law(Path(request["path"]), base64.b64decode(request["text"]))
            return json.dumps(fields_of(self.law)).encode()
        check_answers(self.law)
        return b""


if __name__ == "__main__":
    serve(LawReader().answer)
