"""Every law alone, the empty loop that its time holds, and the reference kernel."""

from benchmarks.conftest import CHOICE
from benchmarks.law_alone import empty_loop, law_alone
from benchmarks.reference_kernel import reference_kernel


def pytest_generate_tests(metafunc):
    """Make a benchmark of each law."""
    if "name" in metafunc.fixturenames:
        laws = metafunc.config.stash[CHOICE].laws
        metafunc.parametrize("name", [law.name for law in laws])


def test_law(name, choice, time_ticks):
    time_ticks(law_alone(choice.find_law(name)))


def test_empty_loop(time_ticks):
    time_ticks(empty_loop())


def test_reference_kernel(time_ticks):
    time_ticks(reference_kernel())
