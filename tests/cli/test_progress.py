"""How far a run is: what is being done is said at once, numbers and the time left only when they are known."""

import time

import pytest
from rich.console import Console

from bench.cli import progress


@pytest.fixture
def clock():
    """A clock that the test moves."""
    return [0.0]


@pytest.fixture
def steps(clock):
    return progress.Steps("episodes", clock=lambda: clock[0])


def test_nothing_is_counted_before_something_is_done(clock, steps):
    steps.now("compiling the laws")
    clock[0] = 90.0
    assert steps.line == "0:01:30  compiling the laws"


def test_time_left_is_of_what_this_run_does_and_not_of_what_was_kept(clock, steps):
    steps.now("native hybrid", 500, 1000)
    clock[0] = 10.0
    steps.now("native hybrid", 600, 1000)
    assert steps.line == "0:00:10  600 of 1,000 episodes (60%), 0:00:40 left: native hybrid"


def test_last_step_says_what_is_made_instead_of_no_time_left(clock, steps):
    steps.now("native hybrid", 1000, 1000)
    steps.now("making traces, operation counts")
    clock[0] = 5.0
    assert steps.line == "0:00:05  making traces, operation counts"


def test_log_gets_lines_while_something_takes_long(capsys):
    with progress.progress("episodes", line_s=0.01) as steps:
        steps.now("compiling the laws")
        time.sleep(0.1)
    lines = capsys.readouterr().err.splitlines()
    assert lines
    assert set(lines) == {"0:00:00  compiling the laws"}
    assert progress.LINE_S < 30.0


def test_log_of_a_short_run_has_no_line(capsys):
    with progress.progress("episodes") as steps:
        steps.now("compiling the laws")
    assert capsys.readouterr().err == ""


def test_terminal_sees_the_step_and_no_number_before_there_is_one(capsys):
    with progress.progress("episodes", screen=Console(stderr=True, force_terminal=True, width=80)) as steps:
        steps.now("compiling the laws")
    said = capsys.readouterr().err
    assert "compiling the laws" in said
    assert "%" not in said
