"""A process of its own answers, or says in one way why it does not: the same for laws and for audited functions."""

import os
import time

import psutil
import pytest

from bench.base.isolated import CRASHED, FORGED, HUNG, KILLED, IsolatedProcess, NoAnswer, Refused, TimeLimits

MODULE = "tests.support.misbehaving"
LIMITS, SHORT = TimeLimits(processor_s=1.0, wall_s=60.0), TimeLimits(processor_s=1.0, wall_s=4.0)
WAITING = ("sleeps", "halts in a message")
"""Deeds that use no processor time: they have the SHORT limits."""

BADLY = {
    "raises": (CRASHED, "ValueError: no", False),
    "exits": (CRASHED, "it ended its process, exit code 3", True),
    "leaves": (CRASHED, "it ended its process, exit code 3", True),
    "kills itself": (KILLED, "it ended its process, SIGKILL", True),
    "loops": (HUNG, "it did not return within 1 s of processor time", True),
    "sleeps": (HUNG, "it did not return within 4 s", True),
    "eats memory": (CRASHED, "MemoryError: ", False),
    "writes rubbish": (FORGED, "it gave back 1,920,295,522 bytes, and may give 268,435,456", True),
    "halts in a message": (HUNG, "it did not return within 4 s", True),
}
"""Deed -> its fate, the reason, and whether the process that was asked is over."""

IN_A_FORK = BADLY | {
    "exits": (CRASHED, "it ended its process, exit code 3", False),
    "leaves": (CRASHED, "it ended its process, exit code 1", False),
    "kills itself": (KILLED, "it ended its process, SIGKILL", False),
    "loops": (HUNG, "it did not return within 1 s of processor time", False),
    "sleeps": (HUNG, "it did not return within 4 s", False),
}
del IN_A_FORK["writes rubbish"], IN_A_FORK["halts in a message"]
"""The line of the process that was asked is closed there."""


@pytest.mark.parametrize("deed", BADLY)
def test_process_that_misbehaves_says_why_there_is_no_answer(deed):
    with IsolatedProcess(MODULE) as process, pytest.raises(NoAnswer) as raised:
        process.ask({"deed": deed}, SHORT if deed in WAITING else LIMITS)
    error = raised.value
    assert (error.fate, str(error), error.is_over) == BADLY[deed]


@pytest.fixture(scope="module")
def lasting():
    """One process for all requests that are answered in forks."""
    with IsolatedProcess(MODULE) as process:
        yield process


@pytest.mark.parametrize("deed", IN_A_FORK)
def test_fork_that_misbehaves_costs_its_own_answer(lasting, deed):
    with pytest.raises(NoAnswer) as raised:
        lasting.ask({"deed": deed}, SHORT if deed in WAITING else LIMITS, in_fork=True)
    error = raised.value
    assert (error.fate, str(error), error.is_over) == IN_A_FORK[deed]
    assert lasting.ask({"deed": "answers"}, LIMITS) == b'"answers"'


def test_forks_do_not_use_up_the_limit_of_the_request_before_them():
    """Four forks cost the process 2.4 s of processor time: more than its 1 s, rounded up."""
    with IsolatedProcess(MODULE) as process:
        process.ask({"deed": "makes forks dear"}, LIMITS)
        for _ in range(4):
            assert process.ask({"deed": "answers"}, LIMITS, in_fork=True) == b'"answers"'


@pytest.mark.parametrize("in_fork", [False, True])
def test_mistake_of_the_caller_comes_back_as_it_is(lasting, in_fork):
    with pytest.raises(Refused, match=r"^kp 0 is no gain$"):
        lasting.ask({"deed": "refuses"}, LIMITS, in_fork=in_fork)


def test_progress_comes_before_the_answer(lasting):
    numbers = []
    assert lasting.ask({"deed": "makes progress"}, LIMITS, progress=numbers.append) == b'"makes progress"'
    assert numbers == [1, 2, 3]


def test_answer_that_is_too_long_is_none(tmp_path):
    with IsolatedProcess(MODULE) as process, pytest.raises(NoAnswer, match="it gave back 10 bytes") as raised:
        process.ask({"deed": "answers"}, LIMITS, most=9)
    assert raised.value.fate == FORGED


@pytest.mark.parametrize("is_in_fork", [False, True])
def test_what_was_started_ends_with_the_process_and_its_folder_is_gone(is_in_fork):
    with IsolatedProcess(MODULE) as process:
        pid = int(process.ask({"deed": "starts another"}, LIMITS, in_fork=is_in_fork))
        folder = process.folder.name
        assert psutil.pid_exists(pid)
    deadline = time.monotonic() + 60.0
    while psutil.pid_exists(pid) and psutil.Process(pid).status() != psutil.STATUS_ZOMBIE:
        assert time.monotonic() < deadline
        time.sleep(0.01)
    assert not os.path.exists(folder)
