"""Make base and head ready: where the sources and law files of each lie, and the folder of a finished run."""

import contextlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from bench.contenders.described_law import described
from bench.errors import BadLaw, BadResults
from bench.provenance import ROOT
from bench.regression.revisions.commits import check_out, find_commit, find_repository
from bench.regression.revisions.timing import Asked

DIGEST = "from bench.provenance import source_digest; print(source_digest())"
"""Each checkout knows which files belong to its sources."""
PART = ("--engine", "ideal-rk4", "--engine", "native", "--task", "free-body", "--count", "40")
"""The part of the quick suite through which all laws are run; `make gate` runs the whole."""


class Checkout(NamedTuple):
    """A side: its name, the benchmark's sources and their digest, and the user's law files that load there.

    own: whether only the user's laws are compared, both by this benchmark.
    """

    name: str
    path: Path
    sources: str
    laws: tuple[Path, ...]
    own: bool

    @property
    def is_new(self) -> bool:
        """Return whether there is nothing to compare: none of the law files is there yet."""
        return self.own and not self.laws

    @property
    def asked(self) -> Asked:
        """Return what is timed of it."""
        return Asked(self.path, self.laws, self.own)


@contextlib.contextmanager
def check_out_both(base: str, head: str | None, laws: tuple[Path, ...]) -> Iterator[tuple[Checkout, Checkout]]:
    """Check out base and head for as long as the block lasts; head None means the files in the checkout.

    Args:
        laws: a user's files; revisions are then of their repository.
    Errors:
        UnknownWord: there is no such revision. Incompatible: git cannot do it.
    """
    folder = find_repository(laws)
    with contextlib.ExitStack() as stack:
        old = _make(stack, folder, base, laws)
        yield old._replace(laws=tuple(law for law in old.laws if _loads(law))), _make(stack, folder, head, laws)


def _loads(law: Path) -> bool:
    try:
        return bool(described(law))
    except BadLaw:
        return False


def _make(stack: contextlib.ExitStack, folder: Path, revision: str | None, laws: tuple[Path, ...]) -> Checkout:
    commit = find_commit(folder, revision or "HEAD")
    path = stack.enter_context(check_out(folder, commit)) if revision else folder
    files = tuple(file for law in laws if (file := path / law.resolve().relative_to(folder)).is_file())
    sources = ROOT if laws else path
    name = f"{revision} ({commit[:10]})" if revision and not commit.startswith(revision) else commit[:10]
    ended = run_python(sources, "-c", DIGEST)
    if ended.returncode:
        raise BadResults(f"{sources}: these sources do not run ({_last_line(ended.stderr)})")
    return Checkout(name if revision else "working tree", sources, ended.stdout.strip(), files, bool(laws))


def run_python(checkout: Path, *words: str) -> subprocess.CompletedProcess:
    """Run this environment's Python with the sources of a checkout, to its end."""
    environment = {**os.environ, "PYTHONPATH": str(checkout)}
    return subprocess.run([sys.executable, *words], cwd=checkout, env=environment, capture_output=True, text=True)


def _last_line(text: str) -> str:
    return (text.strip().splitlines() or ["it said nothing"])[-1].removeprefix("error: ")


@contextlib.contextmanager
def run_side(side: Checkout, report: Callable[[str], None]) -> Iterator[Path]:
    """Run a user's laws through the quick suite, or all laws through PART of it; give the folder for the block.

    Errors:
        BadResults: the run fails; the message has its last words.
    """
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as temporary:
        report(f"running {'the quick suite' if side.own else 'a part of the quick suite'} of {side.name}")
        folder = Path(temporary) / "run"
        words = ["-m", "bench", "run", "--suite", "quick", "--out", str(folder), *(() if side.own else PART)]
        for law in side.laws:
            words += ["--law", str(law), "--regulator", described(law).name]
        ended = run_python(side.path, *words)
        # 1: some rows of a user's law were lost, and the folder says which
        if ended.returncode not in ((0, 1) if side.own else (0,)) or not (folder / "provenance.json").is_file():
            raise BadResults(f"{side.name}: its quick suite does not run ({_last_line(ended.stderr)})")
        yield folder
