"""Tables as they are read, described in datapackage.json, and estimated from."""

import hashlib
import json
import re
import shutil
import tomllib

import build
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from scipy.stats import binom

from bench.base.errors import BadResults
from bench.base.provenance import ROOT
from bench.cli.details import contact
from bench.cli.details.episodes import outcome_table, summarize_laws, tabulate
from bench.experiments.tables import statistics
from bench.experiments.tables.data_package import MOST_WORDS, described_folder
from bench.experiments.tables.run import FREE_BODY, choose_rows, with_contender
from bench.experiments.tables.schema import RESULTS
from bench.law.control.registry import find_controller
from tasks.verdict import CRASHED, OUTCOMES

LAWS = pd.DataFrame(
    {
        "regulator": ["rotation-matrix", "feedback-linearized", "feedback-linearized"],
        "representation": ["", "mrp", "zyx-euler"],
        "jacobian": ["", "", "analytic"],
        "inverse": ["", "", "solve"],
        "start_set": "uniform",
        "outcome": ["settled", "settled", "diverged"],
        "settling_time_s": [1.0, 2.0, float("nan")],
    }
)
NAMES = ["rotation-matrix", "feedback-linearized/mrp", "feedback-linearized/zyx-euler@analytic+solve"]


def test_contender_is_the_word_of_the_command_line_and_in_a_table_of_times_the_law():
    assert list(with_contender(LAWS)["contender"]) == NAMES
    assert list(with_contender(LAWS[["regulator", "representation"]])["contender"])[2] == NAMES[2].split("@")[0]


def test_free_body_has_no_jacobian():
    assert list(choose_rows(LAWS, FREE_BODY)["regulator"]) == ["rotation-matrix", "feedback-linearized"]


def test_summary_and_outcomes_keep_a_law_on_an_arm_apart():
    assert list(summarize_laws(LAWS)["law"]) == NAMES
    assert list(summarize_laws(LAWS)["worst s"]) == ["1.000", "2.000", "never"]
    table = outcome_table(LAWS).set_index("law")
    assert (table.at[NAMES[2], "diverged"], table.at[NAMES[1], "diverged"]) == (1, 0)


IN_CONTACT = pd.DataFrame(
    {
        "controller": ["hybrid-base", "hybrid", "hybrid", "hybrid", "impedance-geometric"],
        "representation": ["", "zyx-euler", "zyx-euler", "zyx-euler", ""],
        "form": ["inverse", "projected", "projected", "projected", ""],
        "outcome": ["done", "done", "done", "singular", "done"],
        "rest": ["", "at-rest", "creeping", "", ""],
        "leakage_ratio": [0.0, 1.0, 3.0, 50.0, float("nan")],
        "misalignment_rad": [0.0, 0.5, 1.0, float("nan"), 0.0],
        "alignment_error_rad": float("nan"),
    }
)
CONTROLLERS = ["hybrid-base+inverse", "hybrid/zyx-euler+projected", "impedance-geometric"]


def test_contender_in_contact_is_the_word_of_the_command_line():
    names = with_contender(IN_CONTACT)["contender"]
    assert list(names.drop_duplicates()) == CONTROLLERS
    assert [find_controller(name).name for name in CONTROLLERS] == CONTROLLERS


def test_summary_in_contact_is_of_the_poses_that_are_done():
    table = tabulate(IN_CONTACT, contact.describe).set_index("controller")
    assert list(table.index) == CONTROLLERS
    assert list(table["done"]) == ["1/1", "2/3", "1/1"]
    assert table["at rest"].str.endswith(("0/0", "1/2")).all()
    assert (table["at rest"] == "1/2").sum() == 1
    assert list(table["leakage"]) == ["0.000  0.000", "2.000  3.000", ""]
    assert table.at[CONTROLLERS[1], "misaligned deg"] == "42.972  57.296"
    assert set(table["off the plate deg"]) == {""}


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


def test_descriptor_has_a_title_and_the_version_of_the_project():
    described = described_folder(REFERENCE)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert described["version"] == project["version"]
    assert described["title"]
    for one in described["resources"]:
        assert one["title"].lower().replace(" ", "-") == one["name"]
        assert len(one["description"]) > 10
        assert ".parquet: " not in one["description"]


def test_descriptor_has_keys_that_name_each_row_once():
    for one in described_folder(REFERENCE)["resources"]:
        key = one["schema"]["primaryKey"]
        rows = pd.read_parquet(REFERENCE / one["path"], columns=key)
        assert len(rows) > 0
        assert not rows.duplicated().any(), one["name"]
        assert one["schema"]["missingValues"] == []  # the empty word in a key is a word


def test_descriptor_lists_the_words_of_columns_that_have_few():
    for one in described_folder(REFERENCE)["resources"]:
        rows = pd.read_parquet(REFERENCE / one["path"])
        for field in one["schema"]["fields"]:
            words = set(rows[field["name"]].dropna().astype(str)) if field["type"] == "string" else set()
            listed = field.get("constraints", {}).get("enum", [])
            assert listed == (sorted(words) if len(words) <= MOST_WORDS else []), (one["name"], field["name"])
    [episodes] = [one for one in described_folder(REFERENCE)["resources"] if one["name"] == "episodes"]
    listed = {field["name"]: field.get("constraints") for field in episodes["schema"]["fields"]}
    assert set(OUTCOMES[:CRASHED]) >= set(listed["outcome"]["enum"]) > {"settled", "stuck"}
    assert listed["start_id"] is None


def test_site_offers_the_descriptor_of_its_data(tmp_path):
    site, run = tmp_path / "site", tmp_path / "run"
    for folder in (site, run):
        folder.mkdir()
    shutil.copy(REFERENCE / "costs.parquet", run)
    (site / "a.html").write_text('<a href="data/costs.parquet"></a><a href="data/datapackage.json"></a>')
    build.offer_data(run, site)
    (resource,) = json.loads((site / "data" / "datapackage.json").read_text(encoding="utf-8"))["resources"]
    content = (site / "data" / resource["path"]).read_bytes()
    assert "bytes" not in resource  # frictionless would find an error of it
    assert resource["hash"] == f"sha256:{hashlib.sha256(content).hexdigest()}"


def test_folder_without_tables_is_refused_with_the_cure(tmp_path):
    with pytest.raises(BadResults, match="give a results folder"):
        described_folder(tmp_path)


NEVER = np.inf


def exact_quantile_interval(values, level):
    """The percentile interval for endlessly many resamples: P(resampled order statistic k <= x_(j)) is binomial."""
    n = len(values)
    k = int(np.ceil(level * n))
    reached = binom.sf(k - 1, n, np.arange(1, n + 1) / n)
    ends = (np.searchsorted(reached, tail) for tail in (statistics.TAIL, 1.0 - statistics.TAIL))
    return tuple(float(np.sort(values)[end]) for end in ends)


@pytest.mark.parametrize("level", [0.5, 0.9])
def test_interval_of_a_quantile_is_that_of_the_binomial_law(level):
    values = np.arange(400.0)
    found = statistics.quantile_estimate(values, level)
    # one standard error of the ends of 2000 resamples is about 0.06 standard errors of the quantile, 10 places here
    assert (found.low, found.high) == pytest.approx(exact_quantile_interval(values, level), abs=2.0)


def test_interval_covers_the_truth_as_often_as_it_says():
    rng = np.random.default_rng(2)
    estimates = [statistics.quantile_estimate(rng.exponential(size=80), 0.5, seed) for seed in range(200)]
    covered = sum(found.low <= np.log(2.0) <= found.high for found in estimates)
    assert 0.95 * 200 - 4 * np.sqrt(200 * 0.95 * 0.05) <= covered


def test_quantile_beyond_the_share_that_settles_is_never():
    times = np.array([1.0] * 98 + [NEVER] * 2)
    assert statistics.quantile_estimate(times, 0.5) == (1.0, 1.0, 1.0)
    assert statistics.quantile(times, 0.98) == 1.0
    found = statistics.quantile_estimate(times, 0.99)
    assert (found.value, found.high) == (NEVER, NEVER)


@pytest.mark.parametrize("level", [0.0, 0.3, 0.5, 0.98, 1.0])
def test_quantile_is_numpys_order_statistic(level):
    values = np.random.default_rng(5).normal(size=(100, 3))
    expected = np.quantile(values, level, axis=0, method="inverted_cdf")
    np.testing.assert_array_equal(statistics.quantile(values, level, axis=0), expected)


def test_bootstrap_refuses_nothing():
    with pytest.raises(ValueError, match="no values to resample"):
        statistics.bootstrap(np.array([]), np.mean)


def test_quantile_takes_the_seventh_of_a_hundred_for_seven_per_cent():
    assert statistics.quantile(np.arange(1.0, 101.0), 0.07) == 7.0
