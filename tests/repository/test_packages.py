"""Every package that a file imports is named in pyproject.toml, in a set that is installed where the file is run."""

import ast
import functools
import importlib.metadata
import re
import sys
import tomllib
from collections import defaultdict

import pytest

from bench.base.provenance import ROOT

FOLDERS = ("bench", "tasks", "report", "tests")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))

PLACES = {
    "bench/studies/libraries/": ("base", "libraries", "asking", "placo", "robosuite"),
    "bench/running/schedulers/cluster.py": ("base", "cluster"),
    "bench/findings/proofs/": ("base", "dev"),
    "tasks/gymnasium_suite.py": ("base", "dev"),
    "report/drawing.py": ("base", "report", "dev"),
    "report/screenshots.py": ("base", "report", "dev"),
    "report/stills.py": ("base", "report", "dev"),
    "report/": ("base", "report"),
    "tests/": ("base", "report", "cluster", "dev"),
    "": ("base",),
}
"""Sets of packages that a file may import, by its place; the first place that fits counts."""

ELSEWHERE = {
    "pinocchio": "pin",
    "pink": "pin-pink",
    "pydrake": "drake",
    "quaternion": "numpy-quaternion",
    "roboticstoolbox": "roboticstoolbox-python",
    "spatialmath": "spatialmath-python",
    "warp": "warp-lang",
}
"""Modules that this environment has not or does not know by their package, and are named otherwise than it."""

SCRIPTS = ("report", "report/extensions", "tests")
"""Folders whose modules are imported without a package: `pythonpath` of pytest, and the book's build."""

LOCKS = {"base": "base", "report": "report", "cluster": "cluster", "dev": "dev", "libraries": "libraries"}


def normalize(name):
    """Return a package's name as registries compare it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def read_requirement(text):
    """Return the name of a requirement, and its pinned version or an empty text."""
    name, version = re.match(r"([\w.-]+)(?:\[.*\])?(?:==([\w.!+-]+))?", text).groups()
    return normalize(name), version or ""


def read_sets():
    """Return the packages of each set: name -> version."""
    project = PROJECT["project"]
    texts = {"base": project["dependencies"], **project["optional-dependencies"]}
    for name, entries in PROJECT["dependency-groups"].items():
        texts[name] = [entry for entry in entries if isinstance(entry, str)]
    return {name: dict(map(read_requirement, entries)) for name, entries in texts.items()}


SETS = read_sets()


@functools.cache
def list_modules_of_ours():
    scripts = {path.stem for folder in SCRIPTS for path in (ROOT / folder).glob("*") if path.suffix in (".py", "")}
    return scripts | set(FOLDERS)


@functools.cache
def packages_by_module():
    return importlib.metadata.packages_distributions()


def list_foreign_modules(text):
    """Return the first names of what a file imports, but Python's own modules and ours."""
    names = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names.update(name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names.add(node.module)
    roots = {name.partition(".")[0] for name in names}
    return roots - sys.stdlib_module_names - list_modules_of_ours()


def find_packages(module):
    """Return the packages that a module may be of."""
    installed = packages_by_module().get(module)
    return set(map(normalize, installed or [ELSEWHERE.get(module, module)]))


def list_allowed(file):
    """Return the packages that are installed where a file is run."""
    sets = next(sets for place, sets in PLACES.items() if file.startswith(place))
    return set().union(*(SETS[name] for name in sets))


def list_unnamed(file, text):
    """Return the modules of a file whose package is in none of its sets."""
    allowed = list_allowed(file)
    return sorted(module for module in list_foreign_modules(text) if not find_packages(module) & allowed)


@functools.cache
def read_files():
    files = {}
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.py")):
            name = path.relative_to(ROOT).as_posix()
            if not name.startswith("report/_build/"):
                files[name] = path.read_text(encoding="utf-8")
    return files


def test_every_package_that_is_imported_is_named():
    importers = defaultdict(list)
    for file, text in read_files().items():
        for module in list_unnamed(file, text):
            importers[module].append(file)
    lines = [f"{module}: {', '.join(files)}" for module, files in importers.items()]
    assert not lines, "name the package in pyproject.toml, where its files are run:\n" + "\n".join(lines)


@pytest.mark.parametrize(
    ("file", "text", "unnamed"),
    [
        ("bench/cli/run.py", "import PIL.Image", ["PIL"]),
        ("report/figures/index.py", "from PIL import Image", []),
        ("bench/law/so3.py", "def f():\n    import sympy\n", ["sympy"]),
        ("bench/findings/proofs/flow.py", "import sympy, os, bench.law", []),
        ("bench/studies/libraries/turns.py", "import pydrake.math, nobody_has_it", ["nobody_has_it"]),
        ("tests/law/test_so3.py", "import dask, bs4, support.bits", []),
    ],
)
def test_package_of_another_set_is_found(file, text, unnamed):
    assert list_unnamed(file, text) == unnamed


def test_every_place_is_there():
    assert [place for place in PLACES if not (ROOT / place).exists()] == []


@pytest.mark.parametrize("name", LOCKS)
def test_lock_has_each_package_that_is_named_at_its_version(name):
    text = (ROOT / "requirements" / f"{LOCKS[name]}.txt").read_text(encoding="utf-8")
    locked = set(re.findall(r"^([a-z0-9._-]+)(?:\[.*\])?==([\w.!+-]+)", text, re.MULTILINE))
    for package, version in {**SETS["base"], **SETS[name]}.items():
        versions = {locked_version for locked_name, locked_version in locked if normalize(locked_name) == package}
        is_locked = version in versions if version else versions
        assert is_locked, f"{package} {version} is not in the lock; run make lock"
