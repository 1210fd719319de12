"""Laws that misbehave: name -> the text of a file, which is sound but for some lines, and what must become of it."""

import tomllib
from pathlib import Path

import psutil

from bench.law.contenders.law_process import TOKEN
from support.user_law import law_text, spring_text

WAITS, LOOPS = "it did not return", "it did not return within 1 s"
WRITTEN = """
def written(said):
    for line in range(3, 64):
        try: os.write(line, said)
        except OSError: pass"""


IMPORTS = "import atexit, os, resource, shutil, signal, sys, threading, time"


def top(*lines: str) -> str:
    """A sound law with these lines at the top of its file."""
    return "\n".join((IMPORTS, *lines)) + spring_text(name="NAME")


def each(*lines: str) -> str:
    """A law that does this whenever it is called."""
    return spring_text("k = 0.0", *lines, name="NAME")


def some(line: str) -> str:
    """A law that does this in some states."""
    return each("if R.n[0] < -0.1:", f"    {line}")


def late(line: str) -> str:
    """A file that does this when it is imported in a run, and not when it is first read."""
    return top(f"if 'sandbox_process' in sys.argv[0]: {line}")


PLACES = {"top": top, "each": each, "some": some, "late": late}
DATA = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def table(name: str) -> dict:
    """Return the laws of a table of hostile_laws.toml: the text of each and what becomes of it."""
    return {
        law: (PLACES[place](*(WRITTEN if line == "WRITTEN" else line for line in lines)), becomes)
        for law, (place, lines, becomes) in DATA[name].items()
    }


AT_IMPORT: dict[str, tuple[str | bytes | None, str]] = {
    **table("at-import"),
    "not-utf-8": (top("# caf\xe9").encode("latin-1"), "it is not UTF-8"),
    "nul": (b"x = 1\0", "does not import (SyntaxError"),
    "folder": (None, "there is no such file"),
    "empty": ("", "it has no REGULATOR"),
    "is-a-generator": (law_text("yield omega", name="NAME"), "returned <generator object"),
}
"""Refused, with the reason in one line."""

COMPILED = table("compiled")
"""Run on the engine ideal-rk4: what becomes of all episodes, or of some; "" of a law that runs as a sound one."""

IN_A_TICK = {law: tuple(told) for law, told in DATA["in-a-tick"].items()}
"""Python code: what a law answers in the first tick of an episode, one after the other."""

IN_TURN = """
import atexit, ctypes, resource, signal, threading
{WRITTEN}
BEGINNINGS, ANSWERS = {beginnings}, [{answers}]
"""


def in_turn(beginnings: list[float]) -> str:
    """A law that answers so in episodes that begin with these R.n[0], and else is sound."""
    answers = ", ".join(f"lambda R, omega, goal, gains, u: {one}" for one, _ in IN_A_TICK.values())
    head = IN_TURN.format(WRITTEN=WRITTEN, beginnings=beginnings, answers=answers)
    first = "if R.n[0] in BEGINNINGS: return ANSWERS[BEGINNINGS.index(R.n[0])](R, omega, goal, gains, (-x, -y, -z))"
    return head + spring_text(first, name="NAME")


def left_behind(marker: str) -> list[psutil.Process]:
    """Processes of laws that run still, of those that have this in their environment."""
    found = []
    for process in psutil.process_iter():
        try:
            if {TOKEN, marker} <= process.environ().keys() and process.status() != psutil.STATUS_ZOMBIE:
                found.append(process)
        except psutil.Error:
            continue
    return found
