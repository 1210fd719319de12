"""Which edition of the report this is: its version, and the run behind its numbers."""

import re
from typing import NamedTuple

from bench.provenance import ROOT

VERSION = re.compile(r"^version:\s*(\S+)", re.MULTILINE)
SHORT = 10
"""Digits of a commit that tell it from every other."""


class Edition(NamedTuple):
    """What a citation and a title page say."""

    version: str
    date: str
    commit: str
    suite: str
    episodes: int


def edition(provenance: dict) -> Edition:
    """From CITATION.cff and the provenance.json of the run that is shown."""
    found = VERSION.search((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    commit = provenance["commit"][:SHORT] or "none"
    return Edition(
        found[1] if found else "unknown",
        provenance["finished"].partition("T")[0],
        f"{commit}, with changes" if provenance["dirty"] else commit,
        provenance["suite"],
        provenance["episodes"],
    )
