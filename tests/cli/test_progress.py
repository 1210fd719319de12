"""How far a run is: what is being done is said at once, numbers and the time left only when they are known."""

import time

from rich.console import Console

from bench.cli import progress


def test_time_left_is_said_only_while_something_is_counted_and_is_of_what_this_run_does():
    clock = [0.0]
    steps = progress.Steps("episodes", clock=lambda: clock[0])
    steps.now("compiling the laws")
    clock[0] = 90.0
    assert steps.line == "0:01:30  compiling the laws"
    steps.now("native hybrid", 500, 1000)  # were kept
    clock[0] = 100.0
    steps.now("native hybrid", 600, 1000)
    assert steps.line == "0:01:40  600 of 1,000 episodes (60%), 0:00:40 left: native hybrid"
    steps.now("native hybrid", 1000, 1000)
    steps.now("making traces, operation counts")
    clock[0] = 105.0
    assert steps.line == "0:01:45  making traces, operation counts"


def test_log_gets_lines_while_something_takes_long(capsys):
    # A clock that stands still, because a busy machine may sleep for longer than it is told.
    steps = progress.Steps("episodes", clock=lambda: 0.0)
    with progress._lines(steps, Console(stderr=True, width=80), line_s=0.01):
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
