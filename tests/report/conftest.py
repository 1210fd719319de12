"""One browser for the tests of a module."""

import pytest


@pytest.fixture(scope="module")
def opened():
    """A headless Chromium whose scripts may take five minutes."""
    import screenshots

    with screenshots.browser() as driver:
        driver.set_script_timeout(300)
        yield driver
