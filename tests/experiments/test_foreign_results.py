"""A results folder from elsewhere: it runs no code, writes nothing outside itself, and shows nothing from outside."""

import json
import shutil
import subprocess
import sys

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
import pytest
from support.command_line import TINY, bench, digest, refused, refused_run

from bench.base import files
from bench.base.errors import BadResults
from bench.experiments.tables import store
from bench.experiments.tables.run import VARIABLE, Run, shown_run
from bench.experiments.tables.schema import RESULTS
from bench.findings.selection.tables import select_rows
from bench.law.contenders.registry import contenders_of
from report.figures.cards import regulators
from report.figures.method import provenance as origin

EVIL = """
from pathlib import Path
Path({marker!r}).write_text("ran")
from bench.law import Law
REGULATOR = Law("evil-law", "Evil <b>law</b>", "s", "f", lambda R, omega, goal, gains: (0.0, 0.0, 0.0))
# </pre><script>alert(1)</script>
"""


@pytest.fixture
def theirs(tmp_path):
    """A folder of results as one may download it."""
    return shutil.copytree(RESULTS / "reference", tmp_path / "theirs")


@pytest.fixture
def marker(tmp_path):
    return tmp_path / "marker"


def rename(path, change) -> None:
    """Change the names of the regulators of a table."""
    table = pq.read_table(path)
    at = table.schema.names.index("regulator")
    words = change(table["regulator"].cast(pa.string()))
    pq.write_table(table.set_column(at, table.schema.field(at), words.dictionary_encode()), path)


@pytest.fixture(scope="module")
def renamed(tmp_path_factory):
    """Copy the reference with one law's rows under an unknown name."""
    folder = shutil.copytree(RESULTS / "reference", tmp_path_factory.mktemp("renamed") / "theirs")
    for path in folder.glob("*.parquet"):
        if "regulator" in pq.read_schema(path).names:
            rename(path, lambda words: pc.replace_substring(words, "weighted-columns", "evil-law"))
    return folder


@pytest.fixture
def evil(renamed, tmp_path, marker, monkeypatch):
    """Copy the renamed run and add a file of that name, which leaves a marker when it is run."""
    folder = shutil.copytree(renamed, tmp_path / "evil")
    (folder / "laws").mkdir()
    (folder / "laws" / "evil_law.py").write_text(EVIL.format(marker=str(marker)))
    monkeypatch.setenv(VARIABLE, str(folder))
    return folder


def test_law_from_elsewhere_is_shown_as_text_and_not_run(evil, marker):
    [own] = shown_run().user_laws()
    shown = regulators.page(contenders_of(own)[0], shown_run()).body
    assert (own.name, own.law, marker.exists()) == ("evil-law", None, False)
    assert "was not run" in shown
    assert "interval of the share of uniform starts" in shown
    assert "<script>" not in shown
    assert "REGULATOR" in shown


@pytest.mark.weekly
def test_summary_of_their_results_runs_no_law_of_theirs(capsys, evil, marker):
    assert bench(capsys, "show", evil).code == 0
    assert not marker.exists()


def test_answer_from_their_results_runs_no_law_of_theirs(evil, marker):
    found = select_rows(Run(evil)).contenders
    assert "rotation-matrix" in found
    assert "evil-law" not in found
    assert not marker.exists()


def test_law_runs_once_its_text_is_trusted_and_not_when_a_sign_changes(capsys, evil, marker):
    path = evil / "laws" / "evil_law.py"
    assert bench(capsys, "trust", path).code == 0
    [own] = shown_run().user_laws()
    assert own.title == "Evil <b>law</b>"
    assert marker.exists()
    marker.unlink()
    path.write_text(path.read_text() + "#")
    [own] = shown_run().user_laws()
    assert (own.title, marker.exists()) == ("evil-law", False)


def test_trust_in_a_file_that_is_not_there_is_refused(capsys, tmp_path):
    assert "cannot be trusted" in refused(capsys, "trust", tmp_path / "nowhere.py")


@pytest.mark.parametrize("name", ["<img src=x>.py", "a b.py", "..py"])
def test_law_file_of_an_odd_name_is_refused(evil, name):
    (evil / "laws" / name).write_text("")
    with pytest.raises(BadResults, match="named by a word"):
        shown_run().user_laws()


def test_law_that_leads_outside_is_refused(evil, tmp_path):
    (tmp_path / "secret").write_text("secret")
    (evil / "laws" / "secret.py").symlink_to(tmp_path / "secret")
    with pytest.raises(BadResults, match="it is a link"):
        shown_run().user_laws()


@pytest.mark.parametrize("name", ["episodes.parquet", "provenance.json"])
def test_table_that_leads_outside_is_refused(capsys, theirs, tmp_path, name):
    (theirs / name).rename(tmp_path / name)
    (theirs / name).symlink_to(tmp_path / name)
    assert f"{name}: it is a link" in refused(capsys, "show", theirs)


@pytest.mark.parametrize("name", ["parts", "laws", "costs.parquet", "plan.json"])
def test_run_into_a_folder_that_leads_outside_touches_neither(capsys, theirs, tmp_path, name):
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "mine.txt").write_text("keep me")
    (theirs / "provenance.json").unlink()
    (theirs / name).unlink(missing_ok=True)
    (theirs / name).symlink_to(outside)
    assert "it is a link" in refused_run(capsys, theirs, *TINY)
    assert [path.name for path in outside.iterdir()] == ["mine.txt"]


@pytest.mark.parametrize(
    "word", ["<script>alert(1)</script>", "a|b", "`x`", "$x$", "{eval-rst}", "[a](b)", "x\ny", "\x1b[2J", "&lt;"]
)
def test_word_that_a_page_would_take_for_its_own_is_refused(theirs, word):
    rename(theirs / "episodes.parquet", lambda words: pa.array([word] * len(words)))
    with pytest.raises(BadResults, match="is no word of ours"):
        store.read(theirs, "episodes")


@pytest.mark.parametrize("values", [[b"x"], [["x"]], [{"x": 1}], ["plain"], [True]], ids=repr)
def test_column_of_another_kind_is_refused(theirs, values):
    path = theirs / "episodes.parquet"
    table = pq.read_table(path)
    pq.write_table(table.append_column("more", pa.array(values * table.num_rows)), path)
    with pytest.raises(BadResults, match="ours hold words and numbers"):
        store.read(theirs, "episodes")


def test_table_that_lacks_a_column_is_refused(theirs):
    pq.write_table(pq.read_table(theirs / "episodes.parquet").drop(["outcome"]), theirs / "episodes.parquet")
    with pytest.raises(BadResults, match="no column outcome as ours"):
        Run(theirs).table("episodes")


def test_plan_whose_names_lead_outside_is_refused_as_edited(capsys, theirs):
    plan = json.loads((theirs / "plan.json").read_text())
    plan["units"] = [["../../../x", "../y", "/etc/passwd", "", 0, 10**18, 10**18, 1e300]] * 3
    plan["digest"] = "../../x"
    (theirs / "plan.json").write_text(json.dumps(plan))
    before = digest(theirs.parent)
    assert "plan.json that was edited or damaged" in refused(capsys, "run", *TINY, "--out", theirs)
    assert digest(theirs.parent) == before


@pytest.mark.parametrize("content", ['{"cpu": "\\u001b]0;x\\u0007"}', '{"\\u202e": 1}', '{"x": ' + "[" * 100_000])
def test_json_that_a_terminal_would_obey_or_that_has_no_end_is_refused(tmp_path, content):
    path = tmp_path / "provenance.json"
    path.write_text(content)
    with pytest.raises(BadResults, match="delete the folder"):
        files.read_json(path)


def test_json_of_absurd_size_is_not_read(tmp_path):
    (tmp_path / "plan.json").write_text('{"digest": "0123456789"}')
    with pytest.raises(BadResults, match="more than 10 bytes"):
        files.read_json(tmp_path / "plan.json", most_bytes=10)


def test_file_that_is_no_table_of_ours_is_not_offered(evil):
    (evil / "<img src=x onerror=alert(1)>.parquet").write_bytes((evil / "costs.parquet").read_bytes())
    assert not any("img" in path.name for path in origin.list_files(shown_run()))


WRONG = {"suite": ["quick"], "cpu": "x" * 1000, "episodes": "many", "dirty": 1, "wall_s": None, "arithmetic": {"a": []}}


def write_about(folder, **changed) -> None:
    about = json.loads((folder / "provenance.json").read_text())
    (folder / "provenance.json").write_text(json.dumps(about | changed))


@pytest.mark.parametrize("name", WRONG)
def test_provenance_of_another_type_or_length_is_refused_by_name(capsys, theirs, name):
    write_about(theirs, **{name: WRONG[name]})
    assert f"'{name}' is no " in refused(capsys, "show", theirs, "contact")


def test_markup_in_provenance_is_shown_as_text(capsys, theirs):
    write_about(theirs, cpu="[red]x[/red] {x} %s :smile:")
    assert ", [red]x[/red] {x} %s :smile:, " in bench(capsys, "show", theirs, "contact").out


@pytest.mark.parametrize("metadata", [b"\xff", b"\x1b[2J", b"x" * 1000], ids=repr)
def test_schema_of_a_foreign_table_is_named_in_signs_that_can_be_printed(capsys, theirs, metadata):
    table = pq.read_table(theirs / "compliance.parquet")
    table = table.replace_schema_metadata(table.schema.metadata | {b"orientation-bench schema": metadata})
    pq.write_table(table, theirs / "compliance.parquet")
    said = refused(capsys, "show", theirs, "contact")
    assert (said.isprintable(), "x" * 300 in said) == (True, False)


@pytest.mark.parametrize("banned", ["import pickle", "from joblib import load", "import numpy as np\nnp.load('x')"])
def test_what_runs_code_when_it_reads_is_no_import_of_ours(banned):
    for room in ("bench", "tasks", "report"):
        words = ["check", "--no-cache", "--select", "TID251", "--stdin-filename", f"{room}/new.py", "-"]
        said = subprocess.run([sys.executable, "-m", "ruff", *words], input=banned, text=True, capture_output=True)
        assert (said.returncode, "TID251" in said.stdout) == (1, True), said
