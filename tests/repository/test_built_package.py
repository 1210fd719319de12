"""What the built package has: every module of ours but studies of other programs, which run from a checkout."""

import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest
from support.command_line import python

from bench.base.provenance import ROOT
from tasks.found_starts import FOLDER

pytestmark = pytest.mark.slow

LEFT_OUT = ("bench/studies/libraries/", "bench/studies/real_time/", "bench/studies/restated/")
"""Studies of other programs: they need what no wheel brings, such as C++ sources beside them."""

BUILD = """
from setuptools import build_meta

build_meta.build_wheel("dist")
build_meta.build_sdist("dist")
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Return the modules in the wheel and in the source archive, built from a copy of the sources."""
    tree = tmp_path_factory.mktemp("built")
    unwanted = shutil.ignore_patterns("__pycache__")
    for room in ("bench", "tasks"):
        shutil.copytree(ROOT / room, tree / room, ignore=unwanted)
    for name in ("pyproject.toml", "LICENSE", "README.md"):
        shutil.copy(ROOT / name, tree)
    subprocess.run([sys.executable, "-c", BUILD], cwd=tree, check=True, capture_output=True)
    [wheel] = (tree / "dist").glob("*.whl")
    [archive] = (tree / "dist").glob("*.tar.gz")
    with tarfile.open(archive) as file:
        in_archive = {name.partition("/")[2] for name in file.getnames()}
    return {"wheel": set(zipfile.ZipFile(wheel).namelist()), "archive": in_archive}


@pytest.mark.parametrize("kind", ["wheel", "archive"])
def test_built_package_has_every_module_but_those_of_studies_of_other_programs(built, kind):
    found = {name for name in built[kind] if name.startswith(("bench/", "tasks/")) and name.endswith(".py")}
    ours = {path.relative_to(ROOT).as_posix() for room in ("bench", "tasks") for path in (ROOT / room).rglob("*.py")}
    left_out = {name for name in ours if name.startswith(LEFT_OUT)}
    assert {place for place in LEFT_OUT if any(name.startswith(place) for name in left_out)} == set(LEFT_OUT)
    assert found == ours - left_out


@pytest.mark.parametrize("kind", ["wheel", "archive"])
def test_built_package_has_the_starts_on_arms(built, kind):
    names = {path.name for path in FOLDER.glob("*.json")}
    assert names
    assert {f"tasks/arm_starts/found/{name}" for name in names} <= built[kind]


@pytest.mark.parametrize("study", ["libraries", "real_time", "restated"])
def test_study_that_is_not_in_the_package_runs_from_a_checkout(study):
    assert f"bench.studies.{study}" in python("-m", f"bench.studies.{study}", "--help")
