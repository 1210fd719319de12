"""What is asked of every page and drawing of the book."""

import functools
import importlib
import re
from typing import Any

from bench.experiments.tables.run import run_in
from bench.experiments.tables.schema import RESULTS
from report.figures.kit import style
from report.figures.kit.page import ABSENT, contents, text_of

RUN = run_in(RESULTS / "reference")
"""The published run."""

TWINS = {colour.lower() for pair in style.TWINS.items() for colour in pair}
COLOUR = re.compile(r"#[0-9a-fA-F]{6}\b")
IMAGE = re.compile(r'"data:[^"]*"')


def assert_is_drawn(picture, constant=()):
    """It says its numbers in words, no texts overlap, colours are the palette's, and it is drawn for a phone too.

    Args:
        constant: colours that may be the same on a light page and a dark one.
    """
    assert picture.clashes == ()
    assert len(re.findall(r"\d", picture.alt)) > 1
    assert "nan" not in picture.alt
    assert picture.narrow not in ("", picture.wide)
    for svg in (picture.wide, picture.narrow):
        plain = IMAGE.sub("", svg)
        assert {colour.lower() for colour in COLOUR.findall(plain)} <= TWINS
        assert set(re.findall(r"(?:fill|stroke): (#\w+)", plain)) <= set(constant)


def pasted(module, run):
    """What a page pastes, key by key."""
    return contents(module, run, text_of(module.__name__.removeprefix("report.figures.")))


@functools.cache
def paste_published(name: str) -> dict[str, Any]:
    """Return what a page pastes of one module from the published run, made once a process."""
    return contents(importlib.import_module(f"report.figures.{name}"), RUN, text_of(name))


def assert_is_whole(found):
    """All that the page pastes is there, and every drawing is drawn."""
    assert found
    for key, value in found.items():
        if hasattr(value, "wide"):
            assert_is_drawn(value, constant=("#ffffff",))  # words on a dark cell
        assert hasattr(value, "wide") or not re.search(r"\bnan\b", str(value)), key
        assert ABSENT not in (value.alt if hasattr(value, "wide") else str(value)), key
