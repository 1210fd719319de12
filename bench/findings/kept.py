"""Keep what was found about a run, so that `show` computes it once: the law to use takes ten seconds or more.

A file is named by a digest of all that decides: the run, the committed results that runs are compared with, and every
source. Whatever of it changes, the name is another one, and all is computed again. The files lie in this user's cache
and not in the run's folder: a folder may come from anywhere, and would bring findings of its own.
"""

import contextlib
import hashlib
import json
from collections.abc import Callable
from pathlib import Path

from bench.base.errors import BadResults
from bench.base.files import read_json, write_json
from bench.base.provenance import everything_digest, kept_in
from bench.experiments.tables.schema import RESULTS

COMMITTED = ("gains", "maps", "proofs", "timings", "reference", "situations")
"""Folders of results/ that runs are compared with."""

KEPT = 64
"""Files that are kept, the newest: some 50 kB each."""


def home() -> Path:
    """Return the folder of the files."""
    return kept_in("XDG_CACHE_HOME", ".cache") / "found"


def keep(folder: Path, what: str, find: Callable[[], dict]) -> dict:
    """Return what `find` finds about the run in a folder, from an earlier call with this word if it would be the same.

    A run of a user's own laws is looked at every time: what may be said of it depends on whether they are trusted.
    """
    if (folder / "laws").exists():
        return find()
    path = home() / f"{what}-{_digest(folder)}.json"
    with contextlib.suppress(BadResults):  # none, or damaged: it is made again
        kept = read_json(path)
        if kept.get("sum") == _sum(kept.get("found")):
            return kept["found"]
    found = find()
    with contextlib.suppress(BadResults):  # a cache that cannot be written costs time, and nothing else
        write_json(path, {"found": found, "sum": _sum(found)})
        for old in sorted(home().glob("*.json"), key=lambda one: one.stat().st_mtime, reverse=True)[KEPT:]:
            old.unlink(missing_ok=True)
    return found


def _sum(found: object) -> str:
    return hashlib.sha256(json.dumps(found, sort_keys=True).encode()).hexdigest()


def _digest(folder: Path) -> str:
    """Return the digest of a run, of what it is compared with (COMMITTED), and of source."""
    digest = hashlib.sha256(everything_digest().encode())
    committed = ((RESULTS / name, "**/*") for name in COMMITTED)
    for root, pattern in ((folder, "*"), *committed):
        for path in sorted(root.glob(pattern)):
            if path.suffix in (".parquet", ".json") and path.is_file():
                digest.update(path.name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()[:32]
