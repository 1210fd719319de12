"""What a user's file says of its law, without the law: read by a process of its own, known by plain words.

    described(path) -> a Law whose functions are in the sandbox alone

Run with a DESCRIPTOR (`module_command`), this module is that process: over the line comes the path and
the text, back go the fields, or the mistake.
"""

import base64
import functools
import json
import signal
import sys
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from bench.base.errors import BadLaw, BenchError
from bench.law.contenders.law_file import check_answers, check_fields, load_law, read_law
from bench.law.contenders.law_process import LawProcess, ending, limit
from bench.law.display import Display, Look
from bench.law.kinds import Law, OnCoordinates, UserFile

LOAD_S, TRIAL_S = 20.0, 5.0
"""Seconds of processor time for a user's file to import, and for its law to be called once."""

ANSWERS = ("fields", "answers")
"""What is said of a file, in this order: what it says of its law, and that the law answers when it is called. One that
crashes or hangs then is known all the same: its rows will say so."""

WAITS_S, TRIAL_WAITS_S = 60.0, 10.0
"""The limit in wall time: for a law that waits, or is kept waiting by a busy machine."""

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
    try:
        file = UserFile(str(path), text.decode())
        own = stand_in(_described(path, text, limit_s, waits_s), file)
        check_fields(own, path)
    except (LookupError, TypeError, AttributeError) as error:
        raise BadLaw(f"--law {path}: its process did not say what it is; correct what runs on import") from error
    return own


@functools.lru_cache(maxsize=32)
def _described(path: Path, text: bytes, limit_s: float, waits_s: float) -> str:
    """Return the fields as JSON; once for the same text."""
    process = LawProcess(__name__, waits_s)
    said: list[dict] = []
    is_late = False
    try:
        asked = {"path": str(path), "text": base64.b64encode(text).decode(), "limit_s": limit_s}
        process.line.send_bytes(json.dumps(asked).encode())
        while len(said) < len(ANSWERS):
            said.append(dict(json.loads(process.hear(min(waits_s, TRIAL_WAITS_S) if said else waits_s))))
    except TimeoutError:
        is_late = True
    except (EOFError, OSError, TypeError, ValueError):
        pass  # its exit code says why, or it wrote to the line itself
    finally:
        code = process.end()
    for one in said:
        if "mistake" in one:
            raise BadLaw(one["mistake"])
    if not said:
        late = f"it did not return within {limit_s:g} s"
        why = late if is_late or code == -signal.SIGXCPU else f"it ended its process, {ending(code)}"
        raise BadLaw(f"--law {path}: it does not load ({why}); correct what runs on import")
    return json.dumps(said[0]["fields"])


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


def main(descriptor: int) -> None:
    """Read the law that is asked for, and say what it is."""
    with Connection(descriptor) as line:
        asked = json.loads(line.recv_bytes())
        try:
            limit(asked["limit_s"])
            own = load_law(Path(asked["path"]), base64.b64decode(asked["text"]))
            line.send_bytes(json.dumps({"fields": fields_of(own)}).encode())
            limit(min(TRIAL_S, asked["limit_s"]))
            check_answers(own)
            line.send_bytes(json.dumps({"answers": True}).encode())
        except BenchError as error:
            line.send_bytes(json.dumps({"mistake": str(error)}).encode())


if __name__ == "__main__":
    main(int(sys.argv[1]))
