"""datapackage.json says of every table what the files themselves hold."""

import hashlib
import json
import re
import shutil

import build
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from bench.base.errors import BadResults
from bench.experiments.tables.data_package import described_folder
from bench.experiments.tables.schema import RESULTS

REFERENCE = RESULTS / "reference"


def of_arrow(kind: pa.DataType) -> str:
    """The word of Table Schema for a column as parquet keeps it."""
    if pa.types.is_floating(kind):
        return "number"
    return "integer" if pa.types.is_integer(kind) else "string"


def test_descriptor_names_every_table_of_the_reference():
    resources = described_folder(REFERENCE)["resources"]
    assert [one["path"] for one in resources] == sorted(path.name for path in REFERENCE.glob("*.parquet"))
    assert all(re.fullmatch(r"[a-z0-9._-]+", one["name"]) for one in resources)


def test_descriptor_has_the_fields_and_types_of_the_files():
    for one in described_folder(REFERENCE)["resources"]:
        found = [(field.name, of_arrow(field.type)) for field in pq.read_schema(REFERENCE / one["path"])]
        assert [(field["name"], field["type"]) for field in one["schema"]["fields"]] == found, one["name"]


def test_site_offers_the_descriptor_of_its_data(tmp_path):
    site, run = tmp_path / "site", tmp_path / "run"
    for folder in (site, run):
        folder.mkdir()
    shutil.copy(REFERENCE / "costs.parquet", run)
    (site / "a.html").write_text('<a href="data/costs.parquet"></a><a href="data/datapackage.json"></a>')
    build.offer_data(run, site)
    (resource,) = json.loads((site / "data" / "datapackage.json").read_text(encoding="utf-8"))["resources"]
    content = (site / "data" / resource["path"]).read_bytes()
    assert resource["bytes"] == len(content)
    assert resource["hash"] == f"sha256:{hashlib.sha256(content).hexdigest()}"


def test_folder_without_tables_is_refused_with_the_cure(tmp_path):
    with pytest.raises(BadResults, match="give a results folder"):
        described_folder(tmp_path)
