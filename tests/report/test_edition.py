"""The edition: its parts, its checksums, and that its wheels and source make the same rows without a network."""

import hashlib
import os
import subprocess

import numpy as np
import pandas as pd
import pytest
import yaml

pytest.importorskip("pypdf", reason="the dev extra is not installed (cure: make test)")

from report import screenshots
from report.edition import CannotMake, __main__, bundle, data, paper, printed, sums, wheels

ROOT = bundle.ROOT
TINY = ("run", "--suite", "quick", "--regulator", "rotation-matrix", "--engine", "native", "--task", "free-body")
MOST_PAGES = 50
NOBODY = "http://127.0.0.1:9"
"""A proxy that is not there."""


def test_checksums_are_of_every_file_and_of_nothing_else(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "one").write_bytes(b"1")
    (tmp_path / "two").write_bytes(b"2")
    for _ in range(2):
        sums.write(tmp_path)
    expected = {"a/one": hashlib.sha256(b"1").hexdigest(), "two": hashlib.sha256(b"2").hexdigest()}
    lines = (tmp_path / sums.NAME).read_text().splitlines()
    assert {name: found for found, name in (line.split("  ") for line in lines)} == expected


def test_paper_cites_what_its_bibliography_has(tmp_path):
    paper.written(tmp_path)
    text, bibliography = ((tmp_path / f"paper.{kind}").read_text() for kind in ("md", "bib"))
    assert paper.cited()
    assert all(f"{{{key}," in bibliography for key in paper.cited())
    _, front, body = text.split("---\n", 2)
    assert {"title", "tags", "authors", "affiliations", "date", "bibliography"} <= set(yaml.safe_load(front))
    assert "$" not in body


def test_data_is_the_published_run_with_its_description(tmp_path):
    data.package(tmp_path)
    published = {path.name: path.read_bytes() for path in data.REFERENCE.glob("*.parquet")}
    assert {path.name: path.read_bytes() for path in (tmp_path / "data").glob("*.parquet")} == published
    assert (tmp_path / "data" / "datapackage.json").is_file()


def test_print_leaves_out_what_is_about_the_tool_and_what_is_alive():
    names = [page.stem for page in printed.chapters()]
    assert names[0] == "index"
    assert {"27-which-law", "40-claims", "06-failure-map"} <= set(names)
    assert not {"26-live", "31-regressions", "34-clusters"} & set(names)


@pytest.mark.skipif(bool(screenshots.missing()), reason=screenshots.missing() or "nothing is missing")
def test_print_is_short_and_opens_at_every_chapter(tmp_path):
    from pypdf import PdfReader

    printed.book(tmp_path)
    made = PdfReader(tmp_path / printed.NAME)
    assert len(printed.chapters()) <= len(made.pages) < MOST_PAGES
    assert len(made.outline) == len(printed.chapters())
    assert "Late braking" in made.pages[0].extract_text()


def test_unknown_part_is_an_error_that_names_the_known(capsys):
    with pytest.raises(SystemExit):
        __main__.main(["sites"])
    assert "no such part: sites; known: site, source, print, data, paper, wheels" in capsys.readouterr().err


def without_index(folder) -> dict[str, str]:
    """The variables of a machine that reaches no network, for its proxy answers nothing, and has no cache of wheels."""
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
    """A folder in which source and wheels of an edition were unpacked and set up, and what runs there."""
    folder = tmp_path_factory.mktemp("edition")
    tree = subprocess.run(["git", "stash", "create"], cwd=ROOT, capture_output=True, text=True, check=False)
    if tree.returncode:
        pytest.skip("no git checkout: there is no source to archive")
    bundle.archive(tree.stdout.strip() or "HEAD", folder / "source.tar")
    try:
        wheels.archive(folder)
    except CannotMake as error:
        pytest.skip(f"the wheels cannot be fetched here: {error}")
    (folder / "home").mkdir()
    subprocess.run(["tar", "xf", "source.tar"], cwd=folder, check=True)
    ours, environment = folder / "orientation-bench", without_index(folder)
    subprocess.run(["make", ".venv/.report", "WHEELS=../wheels"], cwd=ours, env=environment, check=True)
    return ours, environment


@pytest.mark.slow
def test_edition_rebuilds_without_an_index_and_gives_the_same_rows(rebuilt, tmp_path):
    ours, environment = rebuilt
    command = [".venv/bin/python", "-m", "bench", *TINY, "--out", str(tmp_path / "there")]
    subprocess.run(command, cwd=ours, env=environment, check=True, capture_output=True)
    found = pd.read_parquet(tmp_path / "there" / "episodes.parquet")
    published = pd.read_parquet(data.REFERENCE / "episodes.parquet")
    of_them = {"task": "free-body", "regulator": "rotation-matrix", "engine": "native"}
    same = published[np.logical_and.reduce([published[name] == word for name, word in of_them.items()])]
    start = {"start_set": str, "start_id": str}
    both = same.astype(start).merge(found.astype(start), on=list(start))
    assert len(both) == len(same) > 100
    assert (both["outcome_x"].astype(str) == both["outcome_y"].astype(str)).all()
    np.testing.assert_allclose(both["settling_time_s_x"], both["settling_time_s_y"], rtol=1e-6)


@pytest.mark.slow
def test_what_builds_the_book_is_installed_from_the_wheels(rebuilt):
    ours, environment = rebuilt
    said = subprocess.run(
        [".venv/bin/python", "-c", "import jupyter_book, latex2mathml, report.build; print('ready')"],
        cwd=ours,
        env={**environment, "PYTHONPATH": "report"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert said.stdout.strip() == "ready"
