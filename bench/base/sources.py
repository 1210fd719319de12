"""Read what code says: a digest of each file without its comments and docstrings, and the modules that it imports.

Two files have the same digest if Python's parser makes the same tree of both, apart from strings that stand alone.
Such strings are docstrings; nothing that makes rows reads them (tests/repository/test_provenance.py).

Parsing all files takes a second. So what was found is kept in one file for all checkouts, by the digest of the bytes.
"""

import ast
import contextlib
import functools
import hashlib
import json
import sys
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from bench.base.errors import BadResults
from bench.base.files import read_json, write_json
from bench.base.provenance import ROOT, kept_in

PACKAGES = ("bench", "tasks")
"""What is ours, and so may be a dependency."""

SUFFIXES = (".py", ".toml", ".xml", ".json")

BODIES = ("body", "orelse", "finalbody", "handlers", "cases")
"""Fields of a syntax node that hold statements, or what holds them."""

MOST_KEPT = 5000
"""Files of which the digests are kept: some ten states of the sources."""


class Source(NamedTuple):
    """What a file says.

    Attributes:
        code: Digest of its syntax tree without docstrings; of a data file, digest of its content.
        imports: Dotted names of all that it imports, sorted: `from a.b import c` is "a.b.c".
    """

    code: str
    imports: tuple[str, ...]


def scan(content: bytes, package: str = "") -> Source:
    """Return what a Python file says; package: the one that holds it, which relative imports start from."""
    tree = ast.parse(content)
    imports: set[str] = set()
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        imports.update(list_imports(node, package))
        for field in BODIES:
            statements = getattr(node, field, None)
            if isinstance(statements, list):
                statements[:] = [statement for statement in statements if not is_docstring(statement)]
                waiting += statements
    return Source(digest_text(ast.dump(tree)), tuple(sorted(imports)))


def list_imports(node: ast.AST, package: str) -> Iterator[str]:
    """Yield the dotted names that a statement imports; none if it is no import."""
    if isinstance(node, ast.Import):
        for name in node.names:
            yield name.name
    elif isinstance(node, ast.ImportFrom):
        parents = package.split(".")
        start = parents[: len(parents) - node.level + 1] if node.level else []
        path = [*start, node.module] if node.module else start
        for name in node.names:
            yield ".".join([*path, name.name])


def is_docstring(node: ast.AST) -> bool:
    """Tell whether a statement is a string alone, which does nothing."""
    value = node.value if isinstance(node, ast.Expr) else None
    return isinstance(value, ast.Constant) and isinstance(value.value, str)


def digest_text(text: str) -> str:
    """Return 64 hex digits of a text."""
    return hashlib.sha256(text.encode()).hexdigest()


@functools.cache
def scanner() -> str:
    """Return a digest of what the kept digests were made by: this file, and Python, whose trees may differ."""
    return digest_text(Path(__file__).read_text(encoding="utf-8") + sys.version)


class Reader:
    """What the files of a checkout say, each as it was when it was first read.

    Args:
        root: Folder of the packages.
        memory: File in which digests are kept; None keeps none.

    Attributes:
        find_file: Function from the name of a module to its file; None of a name that is not ours.
        follow: Function from the name of a module to its file, the files of its parent packages, and
            those of all that these import. A package that is imported by its name brings all its
            modules: who has it may look into its folder for them.
    """

    def __init__(self, root: Path = ROOT, memory: Path | None = None) -> None:
        self.root, self.memory = root, memory
        self._sources: dict[Path, Source] = {}
        self._times: dict[Path, int] = {}
        self._kept = _read_memory(memory)
        self._has_new = False
        # Each reader has its own caches: a cache on a method would keep every reader until the end.
        self.find_file = functools.cache(self._find_file)
        self.follow = functools.cache(self._follow)
        self._list_needed = functools.cache(self._find_needed)
        self._list_modules = functools.cache(self._find_modules)

    def read(self, path: Path) -> Source:
        """Return what a file says."""
        if path not in self._sources:
            self._times[path] = path.stat().st_mtime_ns
            self._sources[path] = self._scan(path)
        return self._sources[path]

    def _scan(self, path: Path) -> Source:
        content = path.read_bytes()
        if path.suffix == ".toml":
            return Source(digest_text(repr(tomllib.loads(content.decode()))), ())
        if path.suffix != ".py":
            return Source(hashlib.sha256(content).hexdigest(), ())
        package = ".".join(path.relative_to(self.root).parent.parts)
        word = f"{scanner()} {package} {hashlib.sha256(content).hexdigest()}"
        name = digest_text(word)
        with contextlib.suppress(KeyError, TypeError, ValueError):
            code, imports = self._kept[name]
            return Source(str(code), tuple(imports))
        source = scan(content, package)
        self._kept[name] = [source.code, list(source.imports)]
        self._has_new = True
        return source

    def remember(self) -> None:
        """Keep the digests of new files for other processes; without room for it they scan the files again."""
        if not self._has_new or self.memory is None:
            return
        self._has_new = False
        newest = dict(list(self._kept.items())[-MOST_KEPT:])
        with contextlib.suppress(BadResults, OSError):
            write_json(self.memory, {"files": json.dumps(newest)})

    def is_unchanged(self) -> bool:
        """Tell whether all files are as they were when they were read: what is imported later is what was read."""
        with contextlib.suppress(OSError):
            return all(path.stat().st_mtime_ns == time for path, time in self._times.items())
        return False

    def _find_file(self, module: str) -> Path | None:
        if module.partition(".")[0] not in PACKAGES:
            return None
        place = self.root / module.replace(".", "/")
        for path in (place / "__init__.py", place.with_name(f"{place.name}.py")):
            if path.is_file():
                return path
        return None

    def list_files(self, name: str) -> list[Path]:
        """Return all files below a folder, or the one file of this name; name: as "bench/law"."""
        place = self.root / name
        paths = sorted(place.rglob("*")) if place.is_dir() else [place]
        return [path for path in paths if path.suffix in SUFFIXES]

    def _follow(self, module: str) -> frozenset[Path]:
        found: set[str] = set()
        waiting = [module]
        while waiting:
            name = waiting.pop()
            if name not in found:
                found.add(name)
                waiting += self._list_needed(name)
        paths = map(self.find_file, found)
        return frozenset(path for path in paths if path is not None)

    def _find_needed(self, name: str) -> tuple[str, ...]:
        """Return what a name needs at once: its package, or the module that has it; and what its file imports."""
        parent, _, _ = name.rpartition(".")
        needed = {parent} if parent else set()
        path = self.find_file(name)
        for target in self.read(path).imports if path else ():
            if target.partition(".")[0] not in PACKAGES:
                continue
            needed.add(target)
            file = self.find_file(target)
            if file and file.name == "__init__.py":
                needed.update(self._list_modules(file.parent))
        return tuple(needed)

    def _find_modules(self, folder: Path) -> list[str]:
        paths = (path.relative_to(self.root).with_suffix("") for path in folder.rglob("*.py"))
        return [".".join(path.parts).removesuffix(".__init__") for path in paths]

    def digest(self, paths: Iterable[Path], more: str = "") -> str:
        """Return 64 hex digits over the names and the code of files, and over a text."""
        total = hashlib.sha256()
        for path in sorted(paths):
            total.update(f"{path.relative_to(self.root).as_posix()}\0{self.read(path).code}\0".encode())
        total.update(more.encode())
        self.remember()
        return total.hexdigest()


def _read_memory(path: Path | None) -> dict:
    if path is None:
        return {}
    try:
        content = json.loads(read_json(path)["files"])
    except (BadResults, KeyError, TypeError, ValueError):
        return {}  # there is none yet, or it is damaged: files are scanned again
    return content if isinstance(content, dict) else {}


@functools.cache
def reader() -> Reader:
    """Return the reader of this checkout."""
    from bench.base.processes import RUNS_A_LAW

    memory = kept_in("XDG_CACHE_HOME", ".cache") / "sources.json"
    ours = Reader(ROOT, memory)
    if RUNS_A_LAW:
        ours.memory = None  # it reads what is kept and keeps nothing
    return ours
