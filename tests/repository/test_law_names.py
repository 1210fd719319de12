"""Check that sources name a law or coordinates in its own file and in the files that choose among them only."""

import ast
import re
import tomllib
from pathlib import Path

from bench.law.contenders.registry import contenders

ROOT = Path(__file__).parents[2]
ROOMS = ("bench", "tasks", "report")

ALLOWED = tomllib.loads(Path(__file__).with_name("law_names.toml").read_text(encoding="utf-8"))
"""Files and folders that may name them, and why. Anywhere else the registry is asked."""


def words() -> set[str]:
    """Return the names as rows and the command line write them."""
    impedances = (f"impedance-{name}" for name in contenders("impedances"))
    return {*contenders("regulators"), *contenders("representations"), *impedances}


def pattern(every: set[str]) -> re.Pattern:
    """A word with a dash anywhere in a text; one without, which is English too, as the whole text or in a contender."""
    dashed = "|".join(sorted((re.escape(word) for word in every if "-" in word), key=len, reverse=True))
    plain = "|".join(sorted(word for word in every if "-" not in word))
    in_contender = rf"(?<![\w-])(?:{plain})(?=[/@])|(?<=/)(?:{plain})\b"
    return re.compile(rf"(?<![\w-])(?:{dashed})(?![\w-])|^(?:{plain})$|{in_contender}")


def named(path: Path, found: re.Pattern) -> list[str]:
    """The words that the texts of a file have, docstrings apart."""
    tree = ast.parse(path.read_text())
    prose = {id(one.value) for one in ast.walk(tree) if isinstance(one, ast.Expr)}
    texts = (
        one.value
        for one in ast.walk(tree)
        if isinstance(one, ast.Constant) and isinstance(one.value, str) and id(one) not in prose
    )
    return [word for text in texts for word in found.findall(text)]


def namings() -> dict[str, list[str]]:
    """File -> what it names, of all sources."""
    found = pattern(words())
    paths = (path for room in ROOMS for path in sorted((ROOT / room).rglob("*.py")) if "_build" not in path.parts)
    every = {path.relative_to(ROOT).as_posix(): named(path, found) for path in paths}
    return {name: which for name, which in every.items() if which}


def test_nothing_but_what_is_allowed_names_a_law_or_coordinates():
    assert {name: which for name, which in namings().items() if not name.startswith(tuple(ALLOWED))} == {}


def test_whatever_is_allowed_to_name_one_does():
    every = namings()
    assert [place for place in ALLOWED if not any(name.startswith(place) for name in every)] == []


def test_a_word_is_found_in_a_contender_and_not_in_english():
    found = pattern({"late-braking", "mrp"})
    assert found.findall("late-braking@geometric, mrp/quaternion, feedback/mrp") == ["late-braking", "mrp", "mrp"]
    assert found.findall("mrp") == ["mrp"]
    assert found.findall("the mrp-like, late-braking-literal and mrp in a sentence") == []
