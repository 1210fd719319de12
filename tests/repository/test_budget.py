"""Hold each room to its lines of Python, and each file to 250; numbers here only fall (CONTRIBUTING)."""

from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

LINES = {
    "bench/__init__.py": 29,
    "bench/__main__.py": 31,
    "bench/audit": 2_083,
    "bench/base": 494,
    "bench/cli": 2_500,
    "bench/engines": 6_122,
    "bench/experiments": 5_034,
    "bench/export": 1_953,
    "bench/findings": 7_838,
    "bench/law": 6_617,
    "bench/regression": 1_283,
    "bench/running": 2_382,
    "bench/studies": 2_522,
    "tests/audit": 584,
    "tests/cli": 733,
    "tests/conftest.py": 70,
    "tests/contracts": 2_345,
    "tests/engines": 2_678,
    "tests/experiments": 2_189,
    "tests/export": 310,
    "tests/findings": 2_291,
    "tests/law": 2_331,
    "tests/regression": 722,
    "tests/report": 1_668,
    "tests/repository": 513,
    "tests/running": 1_175,
    "tests/studies": 679,
    "tests/support": 3_186,
    "tests/tasks": 1_789,
    "report": 5_924,
    "tasks": 5_188,
}
"""Lines of Python a room. Who needs more takes them from another room and lowers that number in the same commit."""
FILES = {"bench/audit": 38, "bench/experiments": 44, "bench/export": 18, "bench/law": 109, "tasks": 77}
"""Python files of the rooms in which one file adds one thing: with one more, a room may have as many lines more."""
LONGEST_FILE = 250
TOO_LONG: dict[str, int] = {}
"""Files that are still longer, with their lines."""


DATA = {"bench": 3_275, "report": 1_750, "tasks": 489, "tests": 1_034}
"""Lines of text in other files than Python: what moves into them counts too. One new file may come on top."""
SUFFIXES = (".toml", ".text", ".xml", ".js", ".c", ".cpp", ".html", ".css")


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
