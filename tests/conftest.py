"""A finished run that tests copy and spoil; which files are begun first; fresh processes; less search for garbage."""

import gc
import shutil
from collections import Counter
from pathlib import Path

import psutil
import pytest

from bench.experiments import plan as planning

TOOK = "orientation-bench/seconds"
"""In pytest's cache: file -> what its tests took when they were last run [s]."""
SLOW = set(Path(__file__).with_name("slow.txt").read_text(encoding="utf-8").split())
"""Files that are slow as a whole: they compile, or start processes. They run first while no durations are known."""
MOST_BYTES = 640 * 10**6
"""A test process beyond this begins no other file: compiled code is never freed, and a file adds 300 MB at most."""
seconds: Counter = Counter()


def took(config) -> dict:
    """What was kept, as the first process read it: those that it starts must have one and the same order."""
    if hasattr(config, "workerinput"):
        return config.workerinput["took"]
    return config.cache.get(TOOK, {}) if hasattr(config, "cache") else {}


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node):
    """Give it to a process of xdist's."""
    node.workerinput["took"] = took(node.config)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Return the scheduler of `--dist loadfile`, which gives no file to a process that has grown too large."""
    from xdist.scheduler import LoadFileScheduling

    class Replacing(LoadFileScheduling):
        def _reschedule(self, node):
            if self.workqueue and psutil.Process(node.gateway._rinfo().pid).memory_info().rss > MOST_BYTES:
                node.shutdown()  # when it has done what it was given
            super()._reschedule(node)

    return Replacing(config, log) if config.option.dist == "loadfile" else None


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node, error):
    """End a process that has no more to do; start another one while files are left."""
    session = node.config.pluginmanager.getplugin("dsession")
    if error is None:
        node.gateway.exit()
        if getattr(session.sched, "workqueue", ()) and not (session.shouldstop or session.shuttingdown):
            session._clone_node(node)


def is_slow(item) -> bool:
    """Whether the test's file is one of those, or the test is an oracle of the weekly run."""
    return item.path.stem.removeprefix("test_") in SLOW or item.get_closest_marker("weekly") is not None


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Files that take longest first: begun last, one would be left to a single process while the others wait."""
    before = took(config)
    for item in filter(is_slow, items):
        item.add_marker(pytest.mark.slow)
    items.sort(key=lambda item: (-before.get(item.path.stem, 0), not is_slow(item)))


def pytest_runtest_logreport(report):
    """Add up what each file takes."""
    seconds[Path(report.fspath).stem] += report.duration


def pytest_sessionfinish(session):
    """Keep it for the next time, once for all processes."""
    config = session.config
    if hasattr(config, "cache") and not hasattr(config, "workerinput"):
        config.cache.set(TOOK, took(config) | {file: round(total) for file, total in seconds.items()})


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
