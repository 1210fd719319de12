"""Hold each room to its lines of Python, and each file to 250; numbers here only fall (CONTRIBUTING)."""

from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

LINES = {
    "bench/__init__.py": 31,
    "bench/__main__.py": 31,
    "bench/audit": 3_038,
    "bench/base": 473,
    "bench/cli": 2_363,
    "bench/engines": 5_980,
    "bench/experiments": 4_725,
    "bench/export": 2_319,
    "bench/findings": 7_686,
    "bench/law": 6_433,
    "bench/regression": 1_261,
    "bench/running": 2_097,
    "bench/studies": 2_441,
    "tests/audit": 798,
    "tests/cli": 644,
    "tests/conftest.py": 70,
    "tests/contracts": 2_289,
    "tests/engines": 2_655,
    "tests/experiments": 2_158,
    "tests/export": 410,
    "tests/findings": 2_253,
    "tests/law": 2_244,
    "tests/regression": 722,
    "tests/report": 1_659,
    "tests/repository": 513,
    "tests/running": 1_273,
    "tests/studies": 666,
    "tests/support": 3_287,
    "tests/tasks": 1_839,
    "report": 5_701,
    "tasks": 5_046,
}
"""Lines of Python a room. Who needs more takes them from another room and lowers that number in the same commit."""
FILES = {"bench/audit": 49, "bench/experiments": 42, "bench/export": 21, "bench/law": 106, "tasks": 78}
"""Python files of the rooms in which one file adds one thing: with one more, a room may have as many lines more."""
LONGEST_FILE = 250
TOO_LONG: dict[str, int] = {}
"""Files that are still longer, with their lines."""


DATA = {"bench": 3_787, "report": 1_750, "tasks": 489, "tests": 1_055}
"""Lines of text in other files than Python: what moves into them counts too. One new file may come on top."""
SUFFIXES = (".toml", ".text", ".xml", ".js", ".c", ".cpp", ".rs", ".html", ".css")


def python_files(*rooms: str) -> list[Path]:
    """Return the Python files of the rooms that belong to the repository."""
    found = [
        path for room in rooms for path in ([ROOT / room] if room.endswith(".py") else (ROOT / room).rglob("*.py"))
    ]
    return [path for path in found if "_build" not in path.relative_to(ROOT).parts]


def count_lines(path: Path) -> int:
    """Return the number of lines of a file."""
    return len(path.read_text(encoding="utf-8").splitlines())


def list_rooms() -> list[str]:
    """Return the rooms: folders and modules of bench and tests, and tasks and report whole."""
    parts = [
        f"{package}/{path.name}"
        for package in ("bench", "tests")
        for path in sorted((ROOT / package).iterdir())
        if path.suffix == ".py" or (path.is_dir() and any(path.rglob("*.py")))
    ]
    return [*parts, "report", "tasks"]


@pytest.mark.parametrize("room", list_rooms())
def test_a_room_stays_within_its_lines(room):
    lines = sum(count_lines(path) for path in python_files(room))
    has_one_more = len(python_files(room)) - FILES.get(room, 0) == 1
    assert lines <= LINES.get(room, 0) + LONGEST_FILE * has_one_more, (
        f"{room} has {lines} lines: remove some, or lower another room's number by as many"
    )


@pytest.mark.parametrize("package", DATA)
def test_text_in_other_files_than_python_does_not_grow(package):
    paths = [path for path in (ROOT / package).rglob("*") if path.suffix in SUFFIXES]
    lines = [count_lines(path) for path in paths if "_build" not in path.relative_to(ROOT).parts]
    more = sum(lines) - DATA[package]
    assert more <= 0 or (more in lines and more <= LONGEST_FILE), f"{package} has {more} lines more in other files"


def test_no_room_that_is_gone_keeps_its_lines():
    assert set(LINES) <= set(list_rooms())


def test_no_file_is_longer_than_250_lines():
    files = {
        str(path.relative_to(ROOT)): count_lines(path) for path in python_files("bench", "tasks", "report", "tests")
    }
    long = {name: lines for name, lines in files.items() if lines > LONGEST_FILE}
    assert set(long) <= set(TOO_LONG), "split by subject what became too long"
    assert all(long[name] <= TOO_LONG[name] for name in long), "these files only become shorter"
    assert set(TOO_LONG) == set(long), "take a file that is short now off the list"
