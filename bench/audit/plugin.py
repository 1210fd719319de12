"""pytest --orientation-error FUNCTION: a test for each fault of an orientation error (bench/export/wheel.py)."""

from pathlib import Path
from typing import Any

import pytest

from bench.audit.apart import LIMIT_S, audit_apart
from bench.base.errors import BadFunction, BadNumber


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options."""
    group = parser.getgroup("orientation error")
    function = "check it, FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL; repeatable"
    group.addoption("--orientation-error", action="append", default=[], metavar="FUNCTION", help=function)
    allow = "a fault that is intended, as dead-at-180; repeatable"
    group.addoption("--orientation-error-allow", action="append", default=[], metavar="FAULT", help=allow)
    parser.addini("orientation_error_allow", "faults that are intended, as dead-at-180", type="args", default=[])
    limit = f"seconds that its audit may take ({LIMIT_S:g})"
    group.addoption("--orientation-error-limit", type=float, default=LIMIT_S, metavar="SECONDS", help=limit)


def pytest_collection_modifyitems(session: pytest.Session, config: pytest.Config, items: list[pytest.Item]) -> None:
    """Add the checks to the collected tests."""
    for target in config.getoption("orientation_error"):
        items.extend(checks(session, target))


def checks(session: pytest.Session, target: str) -> list[pytest.Item]:
    """Return one test a fault, over one report."""
    config = session.config
    allowed = [*config.getini("orientation_error_allow"), *config.getoption("orientation_error_allow")]
    try:
        said = audit_apart(target, {"allow": allowed}, config.getoption("orientation_error_limit"))
    except (BadFunction, BadNumber) as error:
        raise pytest.UsageError(str(error)) from error
    names = sorted(path.stem.replace("_", "-") for path in Path(__file__).with_name("faults").glob("[a-z]*.py"))
    return [Check.from_parent(session, name=f"{target}[{name}]", fault=name, said=said) for name in names]


class Check(pytest.Item):
    """One fault of one function."""

    def __init__(self, *, fault: str, said: dict[str, Any], **given: Any) -> None:
        super().__init__(**given)
        self.fault, self.said = fault, said

    def runtest(self) -> None:
        """Fail if the function has it."""
        if self.fault in self.said["paragraphs"]:
            pytest.fail(f"{self.said['head']}\n\n{self.said['paragraphs'][self.fault]}", pytrace=False)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Return its place in pytest's lists."""
        return self.path, None, f"orientation error {self.name}"
