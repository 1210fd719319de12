"""Hold that a class name means one thing: no two files of the product define it."""

import ast
from collections import defaultdict
from pathlib import Path

import pytest

from bench.base.provenance import ROOT

ROOMS = ("tasks", "bench", "report")

SHARED = {
    "Chart": {  # the export names its structures by it
        "bench/law/contenders/representations/mrp.py",
        "bench/law/contenders/representations/quaternion.py",
        "bench/law/contenders/representations/rotation_vector.py",
    },
    "Controller": {"bench/engines/loop.py", "bench/studies/libraries/library.py"},
}
"""Names that several files still define. Add none: rename a class, and take its name away here."""


def find_files_of_classes(root: Path) -> dict[str, set[str]]:
    """Return the files that define a class of each name, relative to the root."""
    files = defaultdict(set)
    for room in ROOMS:
        for path in sorted((root / room).rglob("*.py")):
            if "_build" in path.parts:
                continue
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ClassDef):
                    files[node.name].add(path.relative_to(root).as_posix())
    return dict(files)


def find_shared(root: Path) -> dict[str, set[str]]:
    """Return the class names that more than one file defines, with these files."""
    return {name: files for name, files in find_files_of_classes(root).items() if len(files) > 1}


def test_class_name_is_defined_by_one_file():
    new = {name: files - SHARED.get(name, set()) for name, files in find_shared(ROOT).items()}
    assert not {name: files for name, files in new.items() if files}, "say what the class holds"


def test_list_of_shared_class_names_only_shrinks():
    shared = find_shared(ROOT)
    assert {name: shared.get(name, set()) for name in SHARED} == SHARED, (
        "take away here what is renamed"
    )


@pytest.mark.parametrize("second", ["bench/twice.py", "report/figures/twice.py"])
def test_second_class_of_a_name_is_found(tmp_path, second):
    for name in ("tasks/once.py", second):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("class Situation:\n    pass\n", encoding="utf-8")
    assert find_shared(tmp_path) == {"Situation": {"tasks/once.py", second}}
