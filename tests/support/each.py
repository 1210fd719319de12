"""A fixture of all values of a kind."""

import pytest


def each(values):
    """Return a fixture that is each of the values in turn."""
    return pytest.fixture(params=values)(lambda request: request.param)
