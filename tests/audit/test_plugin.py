"""pytest --orientation-error."""

from pathlib import Path

import pytest

pytest_plugins = ("pytester",)


@pytest.fixture
def run(pytester):
    """run(words of pytest...) in a folder with the functions above and one test."""
    pytester.makepyfile(mine=Path(__file__).with_name("errors.python").read_text(), test_one="def test_one(): pass")

    def result(*words):
        return pytester.runpytest("-p", "bench.audit.plugin", "-p", "no:cacheprovider", *words)

    return result


def test_each_fault_is_a_test_beside_the_others(run):
    from bench.audit.faults import every_fault

    result = run("--orientation-error", "mine.py:columns", "-v")
    result.assert_outcomes(passed=1 + len(every_fault()))
    result.stdout.fnmatch_lines(["*mine.py:columns[[]dead-at-180[]] PASSED*"])


def test_fault_fails_its_own_test_and_says_the_cure(run):
    from bench.audit.faults import every_fault

    result = run("--orientation-error", "mine:half")
    result.assert_outcomes(passed=len(every_fault()), failed=1)
    result.stdout.fnmatch_lines(["fault stiffness: *", "*Cure: *", "*FAILED*mine:half[[]stiffness[]]*"])


def test_accepted_fault_passes(run):
    assert run("--orientation-error", "mine:half", "--orientation-error-accept", "stiffness").ret == 0


def test_mistake_is_an_error_of_usage(run):
    result = run("--orientation-error", "mine.py:colums")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: *has no 'colums'*"])


def test_without_the_option_nothing_is_added(run):
    run().assert_outcomes(passed=1)
