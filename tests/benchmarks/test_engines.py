"""Every law in each compiled engine of the free body."""

from benchmarks.conftest import CHOICE
from benchmarks.engine_loops import STARTS, engine_loop


def pytest_generate_tests(metafunc):
    """Make a benchmark of each engine and law that can run in one."""
    names = []
    for law in metafunc.config.stash[CHOICE].laws:
        for engine in STARTS:
            if not law.regulator.costing_only:
                names.append(f"engine {engine} {law.name}")
    metafunc.parametrize("name", names)


def test_engine(name, choice, time_ticks):
    _, engine, law = name.split(" ")
    time_ticks(engine_loop(engine, choice.find_law(law)))
