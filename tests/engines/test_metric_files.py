"""What a file of bench/engines/metrics must hold: METRIC or METRICS, each with a column of its own."""

import importlib
import sys

import pytest

from bench.base.errors import BadMetric
from bench.engines.metrics import registry
from bench.engines.metrics.metric import Metric

ONE = """
from bench.engines.metrics.metric import Metric, as_it_is

def update(value, sample):
    return value

"""
FIRST = 'METRIC = Metric("zeta", "1", "first", 0.0, update, as_it_is)'
PAIR = """METRICS = (
    Metric("{column}", "1", "second", 0.0, update, as_it_is),
    Metric("beta", "1", "third", 0.0, update, as_it_is),
)"""


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package of metrics that are in the files given."""
    monkeypatch.syspath_prepend(tmp_path)

    def of(**files: str):
        folder = tmp_path / "some_metrics"
        folder.mkdir()
        for name, text in {"__init__": "", **files}.items():
            (folder / f"{name}.py").write_text(text)
        return importlib.import_module("some_metrics")

    yield of
    for name in [name for name in sys.modules if name.startswith("some_metrics")]:
        del sys.modules[name]


def test_metrics_of_several_files_stand_in_alphabetical_order(package):
    found = registry.collect(package(a=ONE + FIRST, b=ONE + PAIR.format(column="alpha")), Metric)
    assert list(found) == [one.column for one in found.values()] == ["alpha", "beta", "zeta"]


def test_a_column_that_stands_twice_is_refused(package):
    with pytest.raises(BadMetric, match=r"b\.py: there is a column 'zeta' already"):
        registry.collect(package(a=ONE + FIRST, b=ONE + PAIR.format(column="zeta")), Metric)


def test_a_file_without_a_metric_is_refused(package):
    with pytest.raises(BadMetric, match="has no METRIC that is a Metric, and no METRICS of them"):
        registry.collect(package(a="METRIC = 3.0"), Metric)
