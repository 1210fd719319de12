"""A finished run to copy; names of cases; which files are begun first; a process a file; less search for garbage."""

import gc
import shutil
from pathlib import Path

import pytest
import support.one_thread  # noqa: F401  before what imports NumPy
import z3  # noqa: F401  loaded after OSMesa, which MuJoCo's renderer loads for all, Z3 ends the process
from support.command_line import TINY
from support.forked import run_in_child

from bench.cli import main

SLOW = Path(__file__).with_name("slow.txt").read_text(encoding="utf-8").split()
"""Files that are slow as a whole, the slowest first: they compile, or start processes."""


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_protocol(item, nextitem):
    """Run each file in a child of the process that has collected, where there are several."""
    return run_in_child(item, nextitem) if hasattr(item.config, "workerinput") else None


def pytest_make_parametrize_id(val):
    """Call a value by its own name, column or id."""
    return next((word for at in ("name", "column", "id") if isinstance(word := getattr(val, at, None), str)), None)


def pytest_ignore_collect(collection_path, config):
    """Skip the files of slow tests if the slow tests are deselected."""
    is_slow = collection_path.stem.removeprefix("test_") in SLOW
    return True if is_slow and config.option.markexpr == "not slow" else None


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """The slowest files first: begun last, one would be left to a single process while the others wait."""
    places = {f"test_{word}": place for place, word in enumerate(SLOW)}
    for item in items:
        if item.path.stem in places or item.get_closest_marker("weekly"):
            item.add_marker(pytest.mark.slow)
    items.sort(key=lambda item: places.get(item.path.stem, len(places)))


@pytest.fixture(scope="session", autouse=True)
def state_of_its_own(tmp_path_factory):
    """Laws that tests run are none of this user's, and lines are as wide as in a file: pytest's workers set COLUMNS."""
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("COLUMNS", raising=False)
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield


def pytest_collection_finish():
    """What collecting has loaded stays to the end: the search for garbage need not look at it, nor be so frequent."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)


@pytest.fixture(scope="module")
def run_once(tmp_path_factory):
    """A finished run that tests copy."""
    folder = tmp_path_factory.mktemp("run") / "finished"
    assert main(["run", *TINY, "--engine", "reference", "--workers", "1", "--out", str(folder)]) == 0
    return folder


@pytest.fixture
def finished(run_once, tmp_path):
    return shutil.copytree(run_once, tmp_path / "finished")
