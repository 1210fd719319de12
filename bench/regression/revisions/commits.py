"""What BASE and HEAD mean: a results folder, a git revision, or the files as they lie; and checkouts that go away."""

import contextlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from bench.errors import BadResults, Incompatible, UnknownWord
from bench.provenance import ROOT

WORKING_TREE = "working tree"
MAIN = ("origin/main", "main", "origin/master", "master")


def is_folder(word: str) -> bool:
    """Whether a word names a results folder; a revision of that name is meant only if there is no such folder.

    Errors:
        BadResults: it is written like a path, and nothing is there.
    """
    path = Path(word)
    if path.is_dir():
        return True
    if path.is_absolute() or word.startswith(("./", "../", "results/")):
        raise BadResults(f"{word}: there is no such folder; give a results folder or a git revision (try: git branch)")
    return False


def repository(laws: tuple[Path, ...] = ()) -> Path:
    """The git checkout that revisions are of: of a user's law files, else of this program.

    Errors:
        Incompatible: not in git, or the files are of several repositories.
    """
    folders = {path.resolve().parent for path in laws} or {ROOT}
    found = {git(folder, "rev-parse", "--show-toplevel") for folder in folders}
    if len(found) > 1:
        raise Incompatible(
            f"the --law files lie in several repositories ({', '.join(sorted(found))}); compare each alone"
        )
    return Path(found.pop())


def git(folder: Path, *words: str) -> str:
    """What a git command says.

    Errors:
        Incompatible: it fails; the message is git's own.
    """
    try:
        ended = subprocess.run(["git", "-C", str(folder), *words], capture_output=True, text=True)
    except FileNotFoundError:
        raise Incompatible("git is not installed; compare two results folders instead") from None
    if ended.returncode:
        said = ended.stderr.strip().splitlines() or [f"exit code {ended.returncode}"]
        raise Incompatible(f"git {' '.join(words[:2])} in {folder}: {said[-1]}")
    return ended.stdout.strip()


def commit_of(folder: Path, revision: str) -> str:
    """The commit that a revision is.

    Errors:
        UnknownWord: there is none.
    """
    try:
        return git(folder, "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}")
    except Incompatible:
        known = git(folder, "for-each-ref", "--format=%(refname:short)", "refs/heads", "refs/tags").split()
        raise UnknownWord("revision", revision, known) from None


def default_base(folder: Path, head: str | None) -> str:
    """Where head left main; on main itself the commit before, or the last one if files have changed since.

    Errors:
        Incompatible: there is no main, and so nothing to have left.
    """
    tip = commit_of(folder, head or "HEAD")
    for name in MAIN:
        with contextlib.suppress(Incompatible):
            left = git(folder, "merge-base", tip, name)
            if left != tip:
                return left
            changed = head is None and git(folder, "status", "--porcelain", "--untracked-files=no")
            return tip if changed else commit_of(folder, f"{tip}~1")
    raise Incompatible(f"no branch of {', '.join(MAIN)} is here; name the base (try: python -m bench compare HEAD~1)")


@contextlib.contextmanager
def worktree(folder: Path, commit: str) -> Iterator[Path]:
    """A commit checked out apart from the user's own files; gone when the block ends, however it ends.

    Its files are as old as the commit and lie in the same place each time: numba's cache knows files by place and time.
    """
    path = Path(tempfile.gettempdir()) / f"orientation-bench-{commit[:12]}"
    git(folder, "worktree", "prune")
    if path.exists():  # another comparison's, at this moment
        path = Path(tempfile.mkdtemp(prefix="orientation-bench-")) / "checkout"
    try:
        git(folder, "worktree", "add", "--detach", str(path), commit)
        made = int(git(folder, "show", "--no-patch", "--format=%ct", commit))
        for file in path.rglob("*.py"):
            os.utime(file, (made, made))
        yield path
    finally:
        shutil.rmtree(path, ignore_errors=True)
        git(folder, "worktree", "prune")
        if path.name == "checkout":
            path.parent.rmdir()
