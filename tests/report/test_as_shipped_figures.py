"""Controllers as they are shipped, on their page: statements are those of the rows."""

import shutil

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole

from bench.experiments.experiment import Settings
from bench.experiments.shipped import compare
from bench.experiments.tables import store
from bench.experiments.tables.schema import RESULTS
from bench.law.contenders.registry import contenders
from report.figures.kit.page import run_in
from report.figures.libraries import as_shipped


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The reference with the rows of every controller, without laws of ours."""
    folder = tmp_path_factory.mktemp("shipped") / "run"
    shutil.copytree(RESULTS / "reference", folder)
    rows = pd.DataFrame([row for one in contenders("shipped").values() for row in compare(one, (), Settings(), 20.0)])
    store.write_table(folder / "shipped.parquet", rows, "shipped")
    return run_in(folder)


def test_page_is_whole(run):
    assert_is_whole(as_shipped, run)
