"""Run the tests of a file in a child process and log its reports here: what they compile and keep ends with it."""

import os
import sys
import warnings
from multiprocessing.connection import Connection, Pipe

import pytest
from _pytest.runner import runtestprotocol

_children: dict = {}
"""File -> the process that runs its tests, and the connection to it: one at most."""


def run_in_child(item, nextitem) -> bool:
    """Run one test in the child of its file, which begins with the first and ends with the last, and log it here."""
    is_last = nextitem is None or nextitem.path != item.path
    if item.path not in _children:
        _children[item.path] = _start_child(item.session)
    pid, connection = _children[item.path]
    item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
    try:
        connection.send((item.nodeid, None if is_last else nextitem.nodeid))
        found = [
            item.config.hook.pytest_report_from_serializable(config=item.config, data=one) for one in connection.recv()
        ]
        has_ended = False
    except (EOFError, OSError):
        found, has_ended = [_report_end(item)], True
    for report in found:
        item.ihook.pytest_runtest_logreport(report=report)
    item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
    if is_last or has_ended:
        connection.close()
        os.waitpid(pid, 0)
        del _children[item.path]
    return True


def _start_child(session) -> tuple[int, Connection]:
    """Return the number of a new process that runs the tests it is sent, and the connection to it."""
    here, there = Pipe()
    with warnings.catch_warnings():  # of threads, of which only the one that talks to the scheduler lives
        warnings.simplefilter("ignore", DeprecationWarning)
        pid = os.fork()
    if pid:
        there.close()
        return pid, here
    try:
        here.close()
        _serve(there, {item.nodeid: item for item in session.items}, session.config)
    finally:
        os._exit(1)  # nothing of the parent's is closed twice


def _serve(connection, items, config) -> None:
    """Run tests by their names until there are no more."""
    while True:
        try:
            name, after = connection.recv()
        except EOFError:
            break
        reports = runtestprotocol(items[name], log=False, nextitem=items.get(after))
        connection.send([config.hook.pytest_report_to_serializable(config=config, report=one) for one in reports])
    coverage = sys.modules.get("coverage")
    if coverage and (current := coverage.Coverage.current()):
        current.stop()
        current.save()


def _report_end(item):
    """Return the report of a test that has ended its process."""

    def fail():
        pytest.fail("the process of this file ended within this test", pytrace=False)

    return pytest.TestReport.from_item_and_call(item, pytest.CallInfo.from_call(fail, "call"))
