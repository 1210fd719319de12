"""Resolve what BASE and HEAD mean, a folder, a git revision or the files in the checkout; make each ready to run."""

import contextlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from subprocess import PIPE, STDOUT

from bench.base.errors import BadLaw, BadResults, Incompatible, UnknownWord
from bench.base.provenance import ROOT
from bench.law.contenders.described_law import described
from bench.regression.timer import Side, copy_benchmarks

MAIN = ("origin/main", "main", "origin/master", "master")
DIGEST = "from bench.base.provenance import source_digest; print(source_digest())"  # each knows its own sources
PART = (
    *("--engine", "ideal-rk4", "--engine", "native", "--arm", "ur5e", "--count", "16"),
    *("--task", "free-body", "--task", "arm-regulation"),
)
"""The part of the quick suite through which all laws are run; `make gate` runs the whole."""


def is_folder(word: str) -> bool:
    """Return whether a word names a results folder; raise BadResults for a path at which there is none."""
    path = Path(word)
    if not path.is_dir() and (path.is_absolute() or word.startswith(("./", "../", "results/"))):
        raise BadResults(f"{word}: there is no such folder; give a results folder or a git revision (try: git branch)")
    return path.is_dir()


def find_repository(laws: tuple[Path, ...] = ()) -> Path:
    """Return the one git checkout of a user's law files, or of this program if there are none."""
    folders = {path.resolve().parent for path in laws} or {ROOT}
    found = {git(folder, "rev-parse", "--show-toplevel") for folder in folders}
    if len(found) > 1:
        raise Incompatible(f"the --law files are in several repositories ({', '.join(found)}); compare each alone")
    return Path(found.pop())


def git(folder: Path, *words: str) -> str:
    """Return what a git command prints; raise Incompatible with git's last words if it fails."""
    try:
        ended = subprocess.run(["git", "-C", str(folder), *words], capture_output=True, text=True)
    except FileNotFoundError:
        raise Incompatible("git is not installed; compare two results folders instead") from None
    if ended.returncode:
        said = ended.stderr.strip().splitlines() or [f"exit code {ended.returncode}"]
        raise Incompatible(f"git {' '.join(words[:2])} in {folder}: {said[-1]}")
    return ended.stdout.strip()


def find_commit(folder: Path, revision: str) -> str:
    """Return the commit of a revision; raise UnknownWord if there is none."""
    try:
        return git(folder, "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}")
    except Incompatible:
        known = git(folder, "for-each-ref", "--format=%(refname:short)", "refs/heads", "refs/tags").split()
        raise UnknownWord("revision", revision, known) from None


def find_default_base(folder: Path, head: str | None) -> str:
    """Return where head left main; on main the commit before, or the last one if files have changed since."""
    tip = find_commit(folder, head or "HEAD")
    for name in MAIN:
        with contextlib.suppress(Incompatible):
            left = git(folder, "merge-base", tip, name)
            if left != tip:
                return left
            changed = head is None and git(folder, "status", "--porcelain", "--untracked-files=no")
            return tip if changed else find_commit(folder, f"{tip}~1")
    raise Incompatible(f"no branch of {', '.join(MAIN)} is here; name the base (try: bench compare HEAD~1)")


@contextlib.contextmanager
def check_out(folder: Path, commit: str) -> Iterator[Path]:
    """Check a commit out for the block: each time at one place and as old as it is, by which numba's cache knows it."""
    path = Path(tempfile.gettempdir(), f"orientation-bench-{commit[:12]}")
    with contextlib.ExitStack() as stack:
        if path.exists():  # another comparison has it at this moment
            path = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="orientation-bench-")), "checkout")
        stack.callback(git, folder, "worktree", "prune")
        stack.callback(shutil.rmtree, path, ignore_errors=True)
        git(folder, "worktree", "prune")
        git(folder, "worktree", "add", "--detach", str(path), commit)
        made = int(git(folder, "show", "--no-patch", "--format=%ct", commit))
        for file in path.rglob("*.py"):
            os.utime(file, (made, made))
        yield path


@contextlib.contextmanager
def check_out_both(base: str, head: str | None, laws: tuple[Path, ...]) -> Iterator[tuple[Side, Side]]:
    """Check out base and head, of the repository of a user's law files if there are any, while the block lasts.

    head None means the files in the checkout.
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
    path = folder
    if revision:
        path = stack.enter_context(check_out(folder, commit))
        if not laws:
            copy_benchmarks(path)
    files = tuple(file for law in laws if (file := path / law.resolve().relative_to(folder)).is_file())
    sources = ROOT if laws else path
    name = f"{revision} ({commit[:10]})" if revision and not commit.startswith(revision) else commit[:10]
    digest = run_python(sources, "-c", DIGEST)
    return Side(sources, files, bool(laws), (), name if revision else "working tree", digest)


def run_python(checkout: Path, *words: str, allowed: tuple[int, ...] = (0,), report: Callable = lambda _: None) -> str:
    """Run Python with a checkout's sources, report shares done, return its last line; BadResults says it on failure."""
    said, command, more = "it said nothing", [sys.executable, "-P", *words], os.environ | {"PYTHONPATH": str(checkout)}
    with subprocess.Popen(command, cwd=checkout, env=more, text=True, stdout=PIPE, stderr=STDOUT) as process:
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
