"""Make base and head ready: where the sources and law files of each lie, and the folder of a finished run."""

import contextlib
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

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

SHARE = re.compile(r"\((\d+)%\)")
"""The share done, in a line of progress of `bench run`."""


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


def run_python(
    checkout: Path, *words: str, allowed: tuple[int, ...] = (0,), heard: Callable[[str], None] = lambda _: None
) -> str:
    """Run Python with the sources of a checkout; return what it prints, or raise BadResults with its last words.

    heard: called with every line on its stderr.
    """
    environment = os.environ | {"PYTHONPATH": str(checkout)}
    last = "it said nothing"
    with (
        tempfile.TemporaryFile("w+", encoding="utf-8") as printed,
        subprocess.Popen(
            [sys.executable, *words], cwd=checkout, env=environment, stdout=printed, stderr=subprocess.PIPE, text=True
        ) as process,
    ):
        for line in process.stderr or ():
            heard(line)
            last = line.strip() or last
        if process.wait() not in allowed:
            raise BadResults(f"{checkout}: python {' '.join(words[:3])} does not run ({last.removeprefix('error: ')})")
        printed.seek(0)
        return printed.read().strip()


@contextlib.contextmanager
def run_side(side: Side, report: Callable) -> Iterator[Path]:
    """Run a user's laws through the quick suite, or all laws through PART of it; give the folder for the block.

    report: called with what is done and the share of it that is done, as the run's own lines say it.
    """
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as temporary:
        doing = f"running {'the quick suite' if side.only else 'a part of the quick suite'} of {side.name}"
        report(doing, 0.0)

        def heard(line: str) -> None:
            if share := SHARE.search(line):
                report(doing, int(share[1]) / 100)

        folder = Path(temporary) / "run"
        words = [*(() if side.only else PART), "--out", str(folder)]
        for law in side.laws:
            words += ["--law", str(law), "--regulator", described(law).name]
        # 1: some rows of a user's law were lost, and the folder says which
        allowed = (0, 1) if side.only else (0,)
        run_python(side.path, "-m", "bench", "run", "--suite", "quick", *words, allowed=allowed, heard=heard)
        yield folder
