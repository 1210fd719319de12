"""pytest --orientation-error FUNCTION: a test for each fault that an orientation error can have.

Where the option is absent nothing but this file is imported.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from bench.audit.report import Report


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options."""
    group = parser.getgroup("orientation error")
    function = "check it, FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL; repeatable"
    group.addoption("--orientation-error", action="append", default=[], metavar="FUNCTION", help=function)
    accept = "a fault of it that is meant; repeatable"
    group.addoption("--orientation-error-accept", action="append", default=[], metavar="FAULT", help=accept)


def pytest_collection_modifyitems(session: pytest.Session, config: pytest.Config, items: list[pytest.Item]) -> None:
    """Add the checks to the collected tests."""
    for target in config.getoption("orientation_error"):
        items.extend(checks(session, target, tuple(config.getoption("orientation_error_accept"))))


def checks(session: pytest.Session, target: str, accept: tuple[str, ...]) -> list[pytest.Item]:
    """One test a fault, over one report.

    Errors:
        UsageError: the function cannot be asked.
    """
    from bench.audit import audit
    from bench.audit.faults import every_fault
    from bench.audit.load import load
    from bench.base.errors import BenchError

    @functools.cache
    def report() -> Report:
        try:
            return audit(load(target), accept=accept, name=target)
        except BenchError as error:
            raise pytest.UsageError(str(error)) from error

    report()
    names = [fault.name for fault in every_fault()]
    return [Check.from_parent(session, name=f"{target}[{name}]", fault=name, report=report) for name in names]


class Check(pytest.Item):
    """One fault of one function."""

    def __init__(self, *, fault: str, report: Callable[[], Report], **given: Any) -> None:
        super().__init__(**given)
        self.fault, self.report = fault, report

    def runtest(self) -> None:
        """Fail if the function has it."""
        from bench.audit.report import paragraph

        report = self.report()
        for finding in report.findings:
            if finding.fault.name == self.fault and finding.is_fault:
                raise Faulty("\n".join((report.head(), "", paragraph(report.name, finding))))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return the report's paragraph, and no trace."""
        return str(excinfo.value) if excinfo.errisinstance(Faulty) else super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Return its place in pytest's lists."""
        return self.path, None, f"orientation error {self.name}"


class Faulty(Exception):
    """A fault, in words."""
