"""The wheel `orientation-audit`, where nothing but it, NumPy and pytest is installed, and a project has our names."""

import importlib.metadata
import json
import os
import re
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import numpy as np
import pytest

from bench.export.subject import find_subject, subject_words
from bench.export.vectors import make_vectors
from bench.export.wheel import build_wheel

BARE = ("numpy", "pytest", "pluggy", "iniconfig", "packaging", "pygments")
EVERY_MODULE = """
import importlib, pkgutil, sys, orientation_audit
assert "numpy" not in sys.modules
for one in pkgutil.walk_packages(orientation_audit.__path__, "orientation_audit."):
    importlib.import_module(one.name)
"""
ASK = """
import importlib, json
flat = lambda answer: sum(map(flat, answer), []) if isinstance(answer, tuple) else [answer]
asked = json.load(open("asked.json"))
for name, entry, given, expected, tolerance in asked:
    found = flat(getattr(importlib.import_module(f"orientation_audit.laws.{name}"), entry)(*given))
    assert all(abs(x - y) <= tolerance for x, y in zip(found, expected, strict=True)), name
print(len(asked))
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    """Return the wheel, built."""
    folder = tmp_path_factory.mktemp("dist")
    build_wheel(folder)
    [path] = folder.glob("*")
    return path


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory) -> Path:
    """Return the folder of commands of an environment with the wheel alone, on this one's NumPy and pytest."""
    place = tmp_path_factory.mktemp("bare")
    venv.create(place, with_pip=False)
    [site] = place.glob("lib/python*/site-packages")
    for name in BARE:
        found = importlib.metadata.distribution(name)
        for part in {file.parts[0] for file in found.files or ()} - {".."}:
            (site / part).symlink_to(found.locate_file(part))
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", str(place / "bin" / "python")]
    subprocess.run([*pip, "install", "--quiet", "--no-index", str(wheel)], check=True)  # with NumPy, as it requires
    (place / "bin" / "pytest").write_text(f"#!{place}/bin/python\nimport pytest\nraise SystemExit(pytest.main())\n")
    (place / "bin" / "pytest").chmod(0o755)
    return place / "bin"


@pytest.fixture(scope="module")
def said(wheel) -> str:
    """Return what the wheel says of itself: its metadata, then its README."""
    with zipfile.ZipFile(wheel) as found:
        [name] = (one for one in found.namelist() if one.endswith(".dist-info/METADATA"))
        return found.read(name).decode()


@pytest.fixture
def run(installed, said, tmp_path):
    """run(words...) in a project with the README's error, and packages whose names are ours."""
    for name in ("bench", "tasks"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("OURS = False")
    (tmp_path / "test_it.py").write_text("import bench, tasks\ndef test_it(): assert not (bench.OURS or tasks.OURS)")
    [error] = re.findall(r"^```python\n(.*?my_error.*?)^```", said, re.DOTALL | re.MULTILINE)
    (tmp_path / "my_error.py").write_text(f"from bench import OURS\n{error}")
    (tmp_path / "bench" / "mine.py").write_text("from my_error import OURS, my_error")
    clean = {"PATH": f"{installed}{os.pathsep}{os.defpath}", "HOME": str(tmp_path)}

    def result(*words: str) -> subprocess.CompletedProcess:
        return subprocess.run(words, cwd=tmp_path, env=clean, capture_output=True, text=True, check=False)

    return result


def test_wheel_is_small_needs_numpy_alone_and_may_be_published(wheel, said):
    assert wheel.stat().st_size < 1_000_000
    assert re.findall(r"^Requires-Dist: (\w+)", said, re.MULTILINE) == ["numpy"]
    assert "Requires-Python: >=3.11\n" in said
    assert "License-File: LICENSE\n" in said
    assert "Do Not Upload" not in said
    assert "$" not in said


def test_commands_of_its_readme_run_in_a_project_with_packages_of_our_names(run, said):
    check, tests, law = re.findall(r"^```sh\n(.*)\n```", said, re.MULTILINE)
    checked = run(*check.split())
    assert (checked.returncode, "FAULTS: stiffness" in checked.stdout, checked.stderr) == (1, True, "")
    for words in (
        tests.split(),
        [*tests.split()[:-1], "my_error.py:my_error"],
        [*tests.split()[:-1], "bench.mine:my_error"],
    ):
        tested = run(*words)
        assert (tested.returncode, "1 failed" in tested.stdout) == (1, True), tested.stdout + tested.stderr
    assert run("pytest").returncode == 0
    assert "Late braking" in run("sh", "-c", law).stdout


def test_command_refuses_a_mistake_on_one_line(run):
    for words, cure in (
        (["chek"], "did you mean 'check'?"),
        (["check", "my_error.py:my_eror"], "it has OURS, np, my_error"),
    ):
        refused = run("orientation-audit", *words)
        assert (refused.returncode, refused.stdout, refused.stderr.count("\n")) == (2, "", 1)
        assert cure in refused.stderr


def test_every_module_imports_and_the_package_itself_imports_nothing(run):
    ended = run("python", "-c", EVERY_MODULE)
    assert (ended.returncode, ended.stderr) == (0, "")


def test_every_law_answers_as_the_benchmark(run, tmp_path):
    asked = []
    for subject in map(find_subject, subject_words()):
        one = next(make_vectors(subject))
        given = []
        for name, value in one.arguments.items():
            given += (
                value if name == "gains" else [np.reshape(value, (3, 3)).tolist() if np.size(value) == 9 else value]
            )
        asked.append((subject.identifier, one.entry, given, one.result + one.memory, one.tolerance))
    (tmp_path / "asked.json").write_text(json.dumps(asked))
    ended = run("python", "-c", ASK)
    assert (ended.stdout, ended.stderr) == (f"{len(subject_words())}\n", "")
