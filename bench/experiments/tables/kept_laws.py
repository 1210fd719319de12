"""The laws in a results folder that are none of ours: run if they are this user's, else known by their rows."""

from __future__ import annotations

from pathlib import Path

from bench.base.errors import BadResults
from bench.base.files import refuse_link
from bench.base.on_first_use import pd
from bench.experiments.tables import trust
from bench.law.contenders.described_law import described
from bench.law.contenders.law_file import WORD
from bench.law.contenders.registry import contenders
from bench.law.kinds import Law, OnCoordinates, UserFile

UNTRUSTED = "a file that came with the results; it was not run"
"""The source of a law that is known by its rows alone."""


def kept_laws(folder: Path, costs: pd.DataFrame) -> tuple[Law, ...]:
    """Return the folder's laws, by name, but those now ours; where one may not run, `costs` says what it acts on.

    BadResults: laws/ is a link or holds one, or a file whose name is no word. BadLaw: of a law that may run.
    """
    refuse_link(folder / "laws")
    paths = sorted((folder / "laws").glob("*.py"))
    ours = contenders("regulators")
    return tuple(_law(path, costs) for path in paths if _word(path) not in ours)


def _word(path: Path) -> str:
    word = path.stem.replace("_", "-")
    if not WORD.fullmatch(word):
        raise BadResults(f"{str(path)!r}: a law's file is named by a word of a-z, 0-9 and _; take it out of the folder")
    return word


def _law(path: Path, costs: pd.DataFrame) -> Law:
    refuse_link(path)
    text = path.read_bytes()
    return described(path, text) if trust.is_own(text) else _by_its_rows(path, costs)


def _by_its_rows(path: Path, costs: pd.DataFrame) -> Law:
    """Return a regulator without a law, on the coordinates that its rows name."""
    word = _word(path)
    rows = costs[costs["regulator"] == word]
    known = contenders("representations")
    coordinates = tuple(name for name in rows["representation"].astype(str).unique() if name in known)
    return Law(
        word,
        title=word,
        source=UNTRUSTED,
        formula="",
        law=OnCoordinates(None, coordinates) if coordinates else None,
        property="nothing is known",
        file=UserFile(str(path)),
    )
