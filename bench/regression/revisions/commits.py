"""Resolve what BASE and HEAD mean: a results folder, a git revision, or the files in the checkout."""

import contextlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from bench.base.errors import BadResults, Incompatible, UnknownWord
from bench.base.provenance import ROOT

MAIN = ("origin/main", "main", "origin/master", "master")


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
