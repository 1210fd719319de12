"""Choose where compiled code is kept between processes. Import it before numba, which reads the folder only once.

There is a folder for each set of versions of Python and of the packages that matter. Which code in it is taken, its own
name says (kept_code.py).
"""

import hashlib
import os
import shutil
from pathlib import Path

from bench.base.processes import RUNS_A_LAW
from bench.base.provenance import ARITHMETIC, cpu_name, kept_in, source_digest, vectors, versions

COMPILER_VARIABLE = "ORIENTATION_BENCH_COMPILER"
"""Environment variable: the command of a C compiler, or `numba`, which compiles where there is none."""

KEPT = 8
"""Sets of versions whose compiled code is kept, the newest first."""


def home() -> Path:
    """Return the folder that holds one cache for each set of versions."""
    return kept_in("XDG_CACHE_HOME", ".cache") / "numba"


def _chosen() -> Path:
    """Return the cache of these versions, which NUMBA_CACHE_DIR overrides; the oldest of the others go."""
    source_digest()  # reads all files now: a file that is edited later is not taken for what was imported
    named = os.environ.get("NUMBA_CACHE_DIR")
    if named:
        return Path(named)
    words = repr(sorted(versions().items()))
    folder = home() / hashlib.sha256(words.encode()).hexdigest()[:16]
    os.environ["NUMBA_CACHE_DIR"] = str(folder)
    if not folder.exists() and home().is_dir() and not RUNS_A_LAW:
        by_age = sorted(home().iterdir(), key=lambda path: path.stat().st_mtime, reverse=True)
        for path in by_age[KEPT - 1 :]:
            shutil.rmtree(path, ignore_errors=True)
    return folder


FOLDER = _chosen()

os.environ["NUMBA_DISABLE_INTEL_SVML"] = "1"
"""Numba would take sines of several lanes from Intel's vector library if that is installed; they are not libm's."""


def mark_of(words: tuple[str, ...]) -> Path:
    """Return the file that says that all code of these words is kept, for these sources and this processor.

    It says only that nobody need compile ahead. Code that was removed since then is compiled where it is needed.
    """
    arithmetic = [os.environ.get(name) for name in (*ARITHMETIC, COMPILER_VARIABLE)]
    decides = repr((words, source_digest(), cpu_name(), vectors(), arithmetic))
    return FOLDER / "marks" / hashlib.sha256(decides.encode()).hexdigest()[:32]
