"""The wheel `orientation-audit`, where nothing but it, NumPy and pytest is installed, and a project has our names."""

import json
import os
import re
import subprocess
import sys
import venv
import zipfile
from importlib.metadata import distribution

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from bench.export.subject import find_subject, subject_words
from bench.export.vectors import make_vectors
from bench.export.wheel import build_wheel

ASK = """
import importlib, json, pkgutil, sys, orientation_audit
assert "numpy" not in sys.modules
for one in pkgutil.walk_packages(orientation_audit.__path__, "orientation_audit."):
    importlib.import_module(one.name)
flat = lambda answer: sum(map(flat, answer), []) if isinstance(answer, tuple) else [answer]
asked = json.load(open("asked.json"))
for name, entry, given, expected, tolerance in asked:
    found = flat(getattr(importlib.import_module(f"orientation_audit.laws.{name}"), entry)(*given))
    assert all(abs(x - y) <= tolerance for x, y in zip(found, expected, strict=True)), name
print(len(asked))
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Return the wheel, built."""
    folder = tmp_path_factory.mktemp("dist")
    build_wheel(folder)
    [path] = folder.glob("*")
    return path


@pytest.fixture(scope="module")
def commands(wheel, tmp_path_factory):
    """Return the folder of commands of an environment with the wheel alone, on this one's NumPy and pytest."""
    place = tmp_path_factory.mktemp("bare")
    venv.create(place, with_pip=False)
    [site] = place.glob("lib/python*/site-packages")
    for one in map(distribution, ("numpy", "pytest", "pluggy", "iniconfig", "packaging", "pygments")):
        for part in {file.parts[0] for file in one.files or ()} - {".."}:
            (site / part).symlink_to(one.locate_file(part))
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", place / "bin" / "python", "install"]
    subprocess.run([*pip, "--quiet", "--no-index", wheel], check=True)  # fails where it requires more
    (place / "bin" / "pytest").write_text(f"#!{place}/bin/python\nimport pytest\nraise SystemExit(pytest.main())\n")
    (place / "bin" / "pytest").chmod(0o755)
    return place / "bin"


@pytest.fixture(scope="module")
def said(wheel):
    """Return what the wheel says of itself: its metadata, then its README."""
    with zipfile.ZipFile(wheel) as found:
        return found.read(f"{wheel.name.removesuffix('-py3-none-any.whl')}.dist-info/METADATA").decode()


@pytest.fixture
def run(commands, said, tmp_path):
    """run(words...) in a project with the README's error, and packages whose names are ours."""
    for name in ("bench", "tasks"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("OURS = False")
    (tmp_path / "test_it.py").write_text("import bench, tasks\ndef test_it(): assert not (bench.OURS or tasks.OURS)")
    [error] = re.findall(r"^```python\n(.*?my_error.*?)^```", said, re.DOTALL | re.MULTILINE)
    (tmp_path / "my_error.py").write_text(f"from bench import OURS\n{error}")
    clean = {"PATH": f"{commands}{os.pathsep}{os.defpath}", "HOME": str(tmp_path)}

    def result(*words):
        return subprocess.run(words, cwd=tmp_path, env=clean, capture_output=True, text=True, check=False)

    return result


def test_wheel_is_small_needs_numpy_alone_and_may_be_published(wheel, said):
    assert wheel.stat().st_size < 1_000_000
    assert re.findall(r"^Requires-\S+: (.*)", said, re.MULTILINE) == [">=3.11", "numpy>=1.24"]
    assert "License-File: LICENSE\n" in said
    assert not re.search(r"Do Not Upload|\$", said)


def test_commands_of_its_readme_run_in_a_project_with_packages_of_our_names(run, said, tmp_path):
    check, tests, actions, law = re.findall(r"^```sh\n(.*)\n```", said, re.MULTILINE)
    checked, refused = run(*check.split()), run(*check.replace("check", "chek").split())
    assert (checked.returncode, "FAULTS: dead-at-180, stiffness" in checked.stdout, checked.stderr) == (1, True, "")
    assert (refused.returncode, refused.stdout, refused.stderr.count("\n")) == (2, "", 1)
    allowed = run(*check.split(), "--allow", "dead-at-180", "--stiffness", "2")
    assert (allowed.returncode, "no fault found, 1 allowed: dead-at-180" in allowed.stdout) == (0, True)
    of_file = tests.replace("my_error:", "my_error.py:")
    allowing = f"{tests} --orientation-error-allow dead-at-180"
    for words, failed in ((tests, 2), (of_file, 2), (allowing, 1), ("pytest", 0)):
        tested = run(*words.split())
        assert tested.returncode == int(failed > 0), tested.stdout + tested.stderr
        assert (f"{failed} failed" in tested.stdout) == (failed > 0), tested.stdout
    R = Rotation.from_rotvec(np.random.default_rng(1).normal(size=(301, 3)))
    action = (R[1:] * R[:-1].inv()).as_rotvec() / 0.5
    np.savez(tmp_path / "log.npz", R=R[:-1].as_matrix(), R_next=R[1:].as_matrix(), action=action)
    found = run("sh", "-c", actions)
    assert (found.returncode, "rotation-vector, base (R' = A R)" in found.stdout, found.stderr) == (0, True, "")
    assert "Late braking" in run("sh", "-c", law).stdout


def test_every_module_imports_and_every_law_answers_as_the_benchmark(run, tmp_path):
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
