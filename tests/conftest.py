"""A finished run that tests copy and spoil; which files are begun first; a process a file; less search for garbage."""

import gc
import shutil
from pathlib import Path

import pytest
from support.forked import run_in_child

from bench.experiments import plan as planning

SLOW = Path(__file__).with_name("slow.txt").read_text(encoding="utf-8").split()
"""Files that are slow as a whole, the slowest first: they compile, or start processes."""


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_protocol(item, nextitem):
    """Run each file in a child of the process that has collected, where there are several."""
    return run_in_child(item, nextitem) if hasattr(item.config, "workerinput") else None


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
    """Laws that tests run are none of this user's."""
    with pytest.MonkeyPatch.context() as patch:
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
    from bench.experiments.choice import Choice
    from bench.law.contenders.registry import find_contender
    from bench.running import run as running

    folder = tmp_path_factory.mktemp("run") / "finished"
    plan = planning.make(
        "quick",
        [find_contender("rotation-matrix")],
        Choice(start_sets=("paper",), engines=("reference",), experiments=("free-body",)),
        horizon_s=0.1,
    )
    running.run(plan, folder, workers=1)
    return folder


@pytest.fixture
def finished(run_once, tmp_path):
    return shutil.copytree(run_once, tmp_path / "finished")
