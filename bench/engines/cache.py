"""Choose where compiled code is kept between processes. Import it before numba, which reads the folder only once.

numba's cache looks only at the file of the function it caches, so an edited law or another mujoco would run stale
code; here the folder is a digest of all our sources and the versions that matter.
"""

import contextlib
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from bench.base.lock import held
from bench.base.provenance import kept_in, source_digest

KEPT = 8
"""States of the sources whose compiled code is kept, the newest first: some 15 MB each."""


def home() -> Path:
    """Return the folder that holds one cache for each state of the sources."""
    return kept_in("XDG_CACHE_HOME", ".cache") / "numba"


def _chosen() -> Path:
    """Return the cache of these sources, which NUMBA_CACHE_DIR overrides; the oldest of the others go."""
    named = os.environ.get("NUMBA_CACHE_DIR")
    if named:
        return Path(named)
    folder = home() / source_digest()
    os.environ["NUMBA_CACHE_DIR"] = str(folder)
    if not folder.exists() and home().is_dir():
        by_age = sorted(home().iterdir(), key=lambda path: path.stat().st_mtime, reverse=True)
        for path in by_age[KEPT - 1 :]:
            shutil.rmtree(path, ignore_errors=True)
    return folder


FOLDER = _chosen()

os.environ["NUMBA_DISABLE_INTEL_SVML"] = "1"
"""Numba would take sines of several lanes from Intel's vector library if that is installed; they are not libm's."""


@contextlib.contextmanager
def to_itself() -> Iterator[None]:
    """Others wait, threads and processes: of two that write its index at once, one would find the other's code."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    with held(FOLDER, waits=True):
        yield
