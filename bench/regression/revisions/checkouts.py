"""Base and head made ready: where each one's sources and law files lie, and the folder of a finished run of it."""

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
from bench.files import read_json
from bench.provenance import ROOT
from bench.regression.revisions.commits import WORKING_TREE, commit_of, repository, worktree
from bench.regression.revisions.process import Laws

LOCK = Path("requirements") / "base.txt"
DIGEST = "from bench.provenance import source_digest; print(source_digest())"
"""Asked of a checkout by itself: what belongs to the sources is its own matter."""


class Checkout(NamedTuple):
    """A side: what it is called, the benchmark's sources, and the user's law files that are there.

    own: whether only the user's laws are judged, by one and the same benchmark. broken: why a law file of base counts
    as not being there.
    """

    name: str
    commit: str
    path: Path
    laws: tuple[Path, ...]
    own: bool
    sources: str
    broken: str = ""

    @property
    def is_new(self) -> bool:
        """Whether there is nothing to judge: none of the law files exists yet."""
        return self.own and not self.laws

    @property
    def asked(self) -> Laws:
        """What its process is asked for."""
        return Laws(self.laws, only=self.own, engines=not self.own)


@contextlib.contextmanager
def checkouts(base: str, head: str | None, laws: tuple[Path, ...]) -> Iterator[tuple[Checkout, Checkout]]:
    """Base and head, each checked out for as long as the block lasts; head None is the files as they lie.

    Args:
        laws: a user's files; revisions are then those of their repository, and the benchmark is this one on both sides.
    Errors:
        UnknownWord: no such revision. Incompatible: git cannot do it.
    """
    folder = repository(laws)
    with contextlib.ExitStack() as stack:
        yield (_that_load(_checkout(stack, folder, base, laws)), _checkout(stack, folder, head, laws))


def _that_load(base: Checkout) -> Checkout:
    """Base without the law files that do not load there: head mends them, and its laws are judged as new ones."""
    loading, broken = [], ""
    for law in base.laws:
        try:
            described(law)
            loading.append(law)
        except BadLaw as error:
            broken = str(error).replace(f"{law}", law.name)
    return base._replace(laws=tuple(loading), broken=broken)


def _checkout(stack: contextlib.ExitStack, folder: Path, revision: str | None, laws: tuple[Path, ...]) -> Checkout:
    commit = commit_of(folder, revision or "HEAD")
    path = stack.enter_context(worktree(folder, commit)) if revision else folder
    files = tuple(path / law.resolve().relative_to(folder) for law in laws)
    sources = ROOT if laws else path
    name = f"{revision} ({commit[:10]})" if revision and not commit.startswith(revision) else commit[:10]
    return Checkout(
        name if revision else WORKING_TREE,
        commit,
        sources,
        tuple(file for file in files if file.is_file()),
        bool(laws),
        _digest(sources),
    )


def _digest(checkout: Path) -> str:
    """The digest of a checkout's sources and of the versions they run with."""
    ended = python_in(checkout, "-c", DIGEST)
    if ended.returncode:
        raise BadResults(f"{checkout}: these sources do not run ({_last(ended.stderr)})")
    return ended.stdout.strip()


def python_in(checkout: Path, *words: str) -> subprocess.CompletedProcess:
    """A Python of this environment, ended, with the sources of a checkout."""
    environment = {**os.environ, "PYTHONPATH": str(checkout)}
    return subprocess.run([sys.executable, *words], cwd=checkout, env=environment, capture_output=True, text=True)


def _last(said: str) -> str:
    return (said.strip().splitlines() or ["nothing said"])[-1]


def locks_agree(base: Checkout, head: Checkout) -> bool:
    """Whether both were locked with the same packages, of which only head's are installed."""
    files = [side.path / LOCK for side in (base, head)]
    return len({file.read_bytes() if file.is_file() else b"" for file in files}) == 1


@contextlib.contextmanager
def finished_run(side: Checkout, report: Callable[[str], None]) -> Iterator[Path]:
    """The folder of a run of the quick suite: the committed reference if these sources made it, else run now.

    The working tree's own run is kept in results/quick, and is not run again while nothing changes.

    Errors:
        BadResults: the run fails; the message has its last words.
    """
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as temporary:
        committed = side.path / "results" / "reference"
        if not side.own and _made_by(committed, side.sources):
            yield committed
            return
        kept = side.path / "results" / "quick"
        folder = Path(temporary) / "run" if side.own else kept
        report(f"running the quick suite of {side.name}")
        words = ["-m", "bench", "run", "--suite", "quick", "--replace", "--out", str(folder)]
        for law in side.laws:
            words += ["--law", str(law), "--regulator", described(law).name]
        ended = python_in(side.path, *words)
        # 1: of a user's law some rows were lost, which the folder says; nobody else's can be
        if ended.returncode not in ((0, 1) if side.own else (0,)) or not (folder / "provenance.json").is_file():
            raise BadResults(
                f"{side.name}: its quick suite does not run ({_last(ended.stderr).removeprefix('error: ')})"
            )
        yield folder


def _made_by(folder: Path, sources: str) -> bool:
    """Whether these sources made the run there, with these versions."""
    path = folder / "provenance.json"
    return path.is_file() and read_json(path).get("sources") == sources
