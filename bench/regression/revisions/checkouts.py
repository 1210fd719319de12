"""Make base and head ready: where the sources and law files of each lie, and the folder of a finished run."""

import contextlib
import os
import re
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from subprocess import PIPE, STDOUT, Popen

from bench.base.errors import BadLaw, BadResults
from bench.base.provenance import ROOT
from bench.law.contenders.described_law import described
from bench.regression.revisions.commits import check_out, find_commit, find_repository
from bench.regression.revisions.timing import Side

DIGEST = "from bench.base.provenance import source_digest; print(source_digest())"  # each knows its own sources
PART = (
    *("--engine", "ideal-rk4", "--engine", "native", "--arm", "ur5e", "--count", "16"),
    *("--task", "free-body", "--task", "arm-regulation"),
)
"""The part of the quick suite through which all laws are run; `make gate` runs the whole."""


@contextlib.contextmanager
def check_out_both(base: str, head: str | None, laws: tuple[Path, ...]) -> Iterator[tuple[Side, Side]]:
    """Check out base and head for as long as the block lasts; head None means the files in the checkout.

    If there are law files of a user's, revisions are of their repository.
    """
    folder = find_repository(laws)
    with contextlib.ExitStack() as stack:
        old = _make(stack, folder, base, laws)
        yield old._replace(laws=tuple(law for law in old.laws if _loads(law))), _make(stack, folder, head, laws)


def _loads(law: Path) -> bool:
    with contextlib.suppress(BadLaw):
        return bool(described(law))
    return False


def _make(stack: contextlib.ExitStack, folder: Path, revision: str | None, laws: tuple[Path, ...]) -> Side:
    commit = find_commit(folder, revision or "HEAD")
    path = stack.enter_context(check_out(folder, commit)) if revision else folder
    files = tuple(file for law in laws if (file := path / law.resolve().relative_to(folder)).is_file())
    sources = ROOT if laws else path
    name = f"{revision} ({commit[:10]})" if revision and not commit.startswith(revision) else commit[:10]
    digest = run_python(sources, "-c", DIGEST)
    return Side(sources, files, bool(laws), (), name if revision else "working tree", digest)


def run_python(checkout: Path, *words: str, allowed: tuple[int, ...] = (0,), report: Callable = lambda _: None) -> str:
    """Run Python with a checkout's sources, report shares done, return its last line; BadResults says it on failure."""
    said, command, more = "it said nothing", [sys.executable, "-P", *words], os.environ | {"PYTHONPATH": str(checkout)}
    with Popen(command, cwd=checkout, env=more, text=True, stdout=PIPE, stderr=STDOUT) as process:
        for line in process.stdout or ():
            said = line.strip() or said
            if share := re.search(r"\d+%", line):
                report(share[0])
    if process.returncode not in allowed:
        raise BadResults(f"{checkout}: python {' '.join(words[:3])} does not run ({said.removeprefix('error: ')})")
    return said


@contextlib.contextmanager
def run_side(side: Side, report: Callable[[str], None]) -> Iterator[Path]:
    """Run a user's laws through the quick suite, or all laws through PART of it; give the folder for the block."""
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as temporary:
        doing = f"running {'the quick suite' if side.only else 'a part of the quick suite'} of {side.name}"
        report(doing)
        folder = Path(temporary) / "run"
        laws = [word for law in side.laws for word in ("--law", str(law), "--regulator", described(law).name)]
        # 1: some rows of a user's law were lost, and the folder says which
        words = ["bench", "run", "--suite", "quick", *(() if side.only else PART), "--out", str(folder), *laws]
        allowed, say = (0, 1) if side.only else (0,), lambda share: report(f"{doing}: {share} done")
        run_python(side.path, "-m", *words, allowed=allowed, report=say)
        yield folder
