"""Plant files in a copy of the repository, among them those that CONTRIBUTING.md shows, and ask what they do there."""

import json
import shutil
from pathlib import Path

from bench.base.provenance import ROOT
from support.command_line import digest, python

SUPPORT = ROOT / "tests" / "support"
TEXTS = {path.stem: path.read_text() for path in (SUPPORT / "planted_texts").glob("*.text")}
RECIPE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
COMMANDS = """
import json, sys
from bench.cli import main

for words in json.loads(sys.argv[1]):
    code = main(words)
    print(sys.argv[2], flush=True)
    if code:
        sys.exit(f"{words}: exit code {code}")
"""
END = "=" * 100


def shown(subject: str, count: int) -> list[str]:
    """Return the first blocks of code that CONTRIBUTING.md shows of a subject."""
    blocks = RECIPE.partition(f"**{subject}, for example.**")[2].split("```")[1::2]
    return [block.partition("\n")[2] for block in blocks[:count]]


def copied(tree: Path) -> Path:
    """A copy of the rooms."""
    for room in ("bench", "tasks", "report"):
        shutil.copytree(
            ROOT / room, tree / room, ignore=shutil.ignore_patterns("__pycache__", "_build", "pages", "index.md")
        )
    return tree


def said(tree: Path, *commands: tuple[str, ...]) -> list[str]:
    """What each command prints in that tree; all must succeed."""
    return ran(tree, "-c", COMMANDS, json.dumps(commands), END).split(END)[:-1]


def ran(tree: Path, *words: str, code: int = 0, **variables: str) -> str:
    """What Python prints there, with these variables of the environment."""
    caches = {"XDG_CACHE_HOME": str(tree / "cache"), "NUMBA_CACHE_DIR": None, "ORIENTATION_BENCH_RESULTS": None}
    return python(*words, cwd=tree, code=code, PYTHONPATH=str(tree), **caches, **variables)


def sources(tree: Path) -> dict[str, str]:
    """Every file that somebody wrote."""
    made = ("results", "cache", "report/_build")
    return {
        name: what for name, what in digest(tree).items() if not name.startswith(made) and "__pycache__" not in name
    }
