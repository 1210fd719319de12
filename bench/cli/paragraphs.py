"""Paragraphs with their heads in a column of their own, as a summary and a plan are printed; where a run comes from."""

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from bench.base.provenance import read_provenance
from bench.cli.screen import console, counted, shown_path, spelled

WIDTH = 100
"""Longest line, where the screen is wider."""

HEAD = 13


class Paragraph(NamedTuple):
    """A head, and sentences each of which begins a line."""

    head: str
    sentences: tuple[str, ...]


def print_paragraphs(*every: Paragraph) -> None:
    """Print some, as wide as the screen and at most WIDTH; names and commands are not broken, to be copied whole."""
    screen = console()
    by = textwrap.TextWrapper(min(screen.width, WIDTH), break_long_words=False, break_on_hyphens=False)
    by.subsequent_indent = " " * HEAD
    lines = []
    for head, sentences in every:
        for place, sentence in enumerate(sentences):
            by.initial_indent = f"{'' if place else head:{HEAD}}"
            lines += by.wrap(spelled(sentence, screen))
    if lines:
        screen.print("\n".join(lines), soft_wrap=True)


def listed(words: Sequence[str]) -> str:
    """Words as a sentence has them: a, b and c."""
    *others, end = words
    return f"{', '.join(others)} and {end}" if others else end


def origin(folder: Path) -> str:
    """Return suite, size, commit, processor and time of a run."""
    found = read_provenance(folder, ("suite", "episodes", "commit", "dirty", "cpu", "wall_s"))
    episodes = sum(found.get(name, 0) for name in ("episodes", "trials", "troubled"))
    changed = " with changes" if found["dirty"] else ""
    return (
        f"{shown_path(folder)}: suite {found['suite']}, {counted(episodes, 'episode')}, commit "
        f"{found['commit'][:10] or 'none'}{changed}, {found['cpu']}, {found['wall_s']} s"
    )
