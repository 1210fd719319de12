"""The offline archive: its parts, its checksums, and that wheels and source make the same rows without a network."""

import hashlib
import os
import subprocess

import numpy as np
import pandas as pd
import pytest

from report import edition

TINY = ("run", "--suite", "quick", "--regulator", "rotation-matrix", "--engine", "native", "--task", "free-body")
NOBODY = "http://127.0.0.1:9"
"""A proxy that is not there."""


def test_checksums_are_of_every_file_and_of_nothing_else(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "one").write_bytes(b"1")
    (tmp_path / "two").write_bytes(b"2")
    for _ in range(2):
        edition.write_sums(tmp_path)
    expected = {"a/one": hashlib.sha256(b"1").hexdigest(), "two": hashlib.sha256(b"2").hexdigest()}
    lines = (tmp_path / edition.SUMS).read_text().splitlines()
    assert {name: found for found, name in (line.split("  ") for line in lines)} == expected


def test_data_is_the_published_run_with_its_description(tmp_path):
    edition.write_data(tmp_path)
    published = {path.name: path.read_bytes() for path in edition.REFERENCE.glob("*.parquet")}
    assert {path.name: path.read_bytes() for path in (tmp_path / "data").glob("*.parquet")} == published
    assert (tmp_path / "data" / "datapackage.json").is_file()


def test_unknown_part_is_an_error_that_names_the_known(capsys):
    with pytest.raises(SystemExit):
        edition.main(["sites"])
    assert "no such part: sites; known: site, source, data, wheels" in capsys.readouterr().err


def without_index(folder) -> dict[str, str]:
    """Return the variables of a machine without a network (its proxy does not exist) and without a cache of wheels."""
    ours = ("PIP_", "UV_", "VIRTUAL_ENV", "no_proxy", "NO_PROXY")
    kept = {name: value for name, value in os.environ.items() if not name.startswith(ours)}
    proxies = ("http_proxy", "https_proxy", "all_proxy", "HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY")
    return {
        **kept,
        **dict.fromkeys(proxies, NOBODY),
        "HOME": str(folder / "home"),
        "XDG_CACHE_HOME": str(folder / "cache"),
        "PIP_CONFIG_FILE": os.devnull,
        "UV_NO_CONFIG": "1",
    }


@pytest.fixture(scope="module")
def rebuilt(tmp_path_factory):
    """Return a folder with an edition's source, set up from its wheels, and the environment of its commands."""
    folder = tmp_path_factory.mktemp("edition")
    tree = subprocess.run(["git", "stash", "create"], cwd=edition.ROOT, capture_output=True, text=True, check=False)
    if tree.returncode:
        pytest.skip("no git checkout: there is no source to archive")
    edition.archive_tree(tree.stdout.strip() or "HEAD", folder / "source.tar")
    try:
        edition.write_wheels(folder)
    except edition.CannotMake as error:
        pytest.skip(f"the wheels cannot be fetched here: {error}")
    (folder / "home").mkdir()
    subprocess.run(["tar", "xf", "source.tar"], cwd=folder, check=True)
    ours, environment = folder / "orientation-bench", without_index(folder)
    subprocess.run(["make", ".venv/.report", "WHEELS=../wheels"], cwd=ours, env=environment, check=True)
    return ours, environment


@pytest.mark.weekly
def test_edition_has_what_builds_the_book_and_gives_the_same_rows_without_an_index(rebuilt, tmp_path):
    ours, environment = rebuilt
    book = [".venv/bin/python", "-c", "import jupyter_book, latex2mathml, report.build"]
    subprocess.run(book, cwd=ours, env={**environment, "PYTHONPATH": "report"}, check=True)
    command = [".venv/bin/python", "-m", "bench", *TINY, "--out", str(tmp_path / "there")]
    subprocess.run(command, cwd=ours, env=environment, check=True, capture_output=True)
    found = pd.read_parquet(tmp_path / "there" / "episodes.parquet")
    published = pd.read_parquet(edition.REFERENCE / "episodes.parquet")
    of_them = {"task": "free-body", "regulator": "rotation-matrix", "engine": "native"}
    same = published[np.logical_and.reduce([published[name] == word for name, word in of_them.items()])]
    start = {"start_set": str, "start_id": str}
    both = same.astype(start).merge(found.astype(start), on=list(start))
    assert len(both) == len(same) > 100
    assert (both["outcome_x"].astype(str) == both["outcome_y"].astype(str)).all()
    np.testing.assert_allclose(both["settling_time_s_x"], both["settling_time_s_y"], rtol=1e-6)
