"""One browser for the tests of a module, and the published run for those whose pages read what is named."""

import pytest

from bench.experiments.tables.run import VARIABLE
from bench.experiments.tables.schema import RESULTS


@pytest.fixture(scope="module")
def opened():
    """A headless Chromium whose scripts may take five minutes."""
    import screenshots

    with screenshots.browser() as driver:
        driver.set_script_timeout(300)
        yield driver


@pytest.fixture
def reference(monkeypatch):
    monkeypatch.setenv(VARIABLE, str(RESULTS / "reference"))
