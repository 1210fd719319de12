"""Every mistake of a caller: one line (what was given, what is allowed, the cure), exit code 2, nothing touched."""

import shutil

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from command_line import TINY, bench, digest

import tasks
from bench import plan as planning
from bench import store
from bench.discovery import known_regulators, known_representations
from bench.errors import BadResults
from bench.suites import SUITES


@pytest.fixture(scope="module")
def run_once(tmp_path_factory):
    """A finished run that the tests of this file copy."""
    from bench import run as running
    from bench.discovery import find_contender

    folder = tmp_path_factory.mktemp("run") / "finished"
    plan = planning.make(
        "quick", [find_contender("rotation-matrix")], start_sets=("paper",), engines=("reference",), horizon_s=0.1
    )
    running.run(plan, folder, workers=1)
    return folder


@pytest.fixture
def finished(run_once, tmp_path):
    return shutil.copytree(run_once, tmp_path / "finished")


def refused(capsys, *words) -> str:
    """The one line of a refused command."""
    said = bench(capsys, *words)
    lines = said.err.splitlines()
    assert (said.code, len(lines)) == (2, 1), said
    assert lines[0].startswith("error: ")
    return lines[0]


def refused_run(capsys, folder, *words) -> str:
    """The one line of a refused run into a folder, which must stay as it is."""
    before = digest(folder)
    line = refused(capsys, "run", "--replace", "--out", folder, *words)
    assert digest(folder) == before
    return line


# ------------------------------------------------------------------------------------------------ words


@pytest.mark.parametrize(
    ("option", "word", "known"),
    [
        ("--suite", "defualt", sorted(SUITES)),
        ("--regulator", "rotation-matrx", sorted(known_regulators())),
        ("--regulator", "linearized-euler/zyx-eular", sorted(known_representations())),
        ("--representation", "zyx", sorted(known_representations())),
        ("--task", "free-bodi", tasks.names()),
        ("--starts", "uniforn", tasks.start_set_names()),
        ("--engine", "nativ", sorted(planning.ENGINES)),
        ("--integrator", "eulr", sorted(planning.INTEGRATORS)),
    ],
)
def test_unknown_word_lists_the_known_ones_and_guesses(capsys, finished, option, word, known):
    line = refused_run(capsys, finished, option, word)
    assert f"'{word.rpartition('/')[2]}' is unknown" in line
    assert f"known: {', '.join(known)}" in line
    assert word == "zyx" or "did you mean" in line


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("list", "regulaters"), "regulators, representations, metrics"),
        (("rum",), "'run'"),
        (("run", "--sweet", "quick"), "--sweet"),
        (("run", "--count", "many"), "--count"),
        (("run", "--dt", "fast"), "--dt"),
        (("run", "--suite"), "--suite"),
        (("compare",), "CANDIDATE"),
        (("show", "a", "b"), "b"),
    ],
)
def test_usage_error_is_one_line_that_names_the_word(capsys, words, named):
    line = refused(capsys, *words)
    assert named in line
    assert "try: " in line or "give one of these" in line


def test_no_command_shows_the_help(capsys):
    said = bench(capsys)
    assert (said.code, said.err) == (0, "")
    assert "compare" in said.out


@pytest.mark.parametrize("option", ["--engine", "--starts"])
def test_show_lists_what_the_run_has_when_asked_for_another(capsys, finished, option):
    line = refused(capsys, "show", finished, option, "nowhere")
    assert {"--engine": "reference", "--starts": "paper"}[option] in line


# ---------------------------------------------------------------------------------------------- numbers


@pytest.mark.parametrize(
    ("option", "number"),
    [
        (option, number)
        for option in ("--dt", "--horizon", "--kp", "--kv")
        for number in ("0", "-1", "nan", "inf", "-inf")
    ]
    + [("--dt", "0.2"), ("--dt", "1e-9"), ("--horizon", "1e-4"), ("--horizon", "1e9"), ("--kp", "1e300")]
    + [("--count", "0"), ("--count", "-3"), ("--count", "1000001")]
    + [("--workers", "0"), ("--workers", "-1"), ("--workers", "1000"), ("--seed", "-1"), ("--seed", "4294967296")],
)
def test_impossible_number_names_the_option_and_the_range(capsys, finished, option, number):
    line = refused_run(capsys, finished, option, number)
    assert line.startswith(f"error: {option} ")
    assert any(word in line for word in ("between", "must lie", "from 0 to"))


def test_impossible_number_is_refused_in_a_dry_run_too(capsys, finished):
    refused_run(capsys, finished, "--dry-run", "--workers", "0")


# ----------------------------------------------------------------------------------------- combinations


def test_law_on_the_matrix_takes_no_representation(capsys, finished):
    line = refused_run(capsys, finished, "--regulator", "rotation-matrix/zyx-euler")
    assert "acts on the rotation matrix and takes no representation" in line


def test_representation_without_a_law_is_refused(capsys, finished):
    line = refused_run(capsys, finished, "--regulator", "rotation-matrix", "--representation", "zyx-euler")
    assert "no chosen law acts on zyx-euler" in line


def test_same_word_twice_is_the_word_once():
    laws = [next(iter(planning.make("quick", [_rotation_matrix()]).contenders))]
    once = planning.make("quick", laws, start_sets=("paper",), engines=("native",))
    twice = planning.make(
        "quick", laws, start_sets=("paper", "paper"), engines=("native", "native"), task_words=("free-body",) * 2
    )
    assert once == twice


def _rotation_matrix():
    from bench.discovery import find_contender

    return find_contender("rotation-matrix")


def test_nothing_to_run_says_which_starts_and_engines_a_task_takes(monkeypatch):
    own = tasks.task("free-body")._replace(name="other", start_sets=("paper",))
    monkeypatch.setattr(tasks, "names", lambda: ["free-body", "other"])
    monkeypatch.setattr(tasks, "task", lambda name: own)
    with pytest.raises(planning.Incompatible, match=r"ideal-rk4 simulates free-body alone, not 'other'"):
        planning.make("quick", [_rotation_matrix()], task_words=("other",), engines=("ideal-rk4",))
    with pytest.raises(planning.Incompatible, match=r"task 'other' takes the starts paper, not poles"):
        planning.make("quick", [_rotation_matrix()], task_words=("other",), engines=("native",), start_sets=("poles",))


# ------------------------------------------------------------------------------------------ a user's law

LAW = """
import math
from bench.contender import Regulator
from bench.scalar import kernel, sqrt

@kernel
def law(R, omega, goal, gains):
    {body}

REGULATOR = Regulator("mine", "Mine", "none", "u", law)
"""


def written(tmp_path, text: str):
    path = tmp_path / "own.py"
    path.write_text(text)
    return path


def law_text(*body: str) -> str:
    return LAW.replace("{body}", "\n    ".join(body))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("def law(:", "does not import (SyntaxError"),
        ("import no_such_package", "does not import (ModuleNotFoundError: No module named 'no_such_package')"),
        ("raise RuntimeError('on\\npurpose')", "does not import (RuntimeError: on purpose)"),
        ("import sys; sys.exit(7)", "does not import (SystemExit: 7)"),
        ("x = 1", "it has no REGULATOR; it needs a constant REGULATOR"),
        ("REGULATOR = 5", "it has a REGULATOR of type int"),
        ("REGULATOR = ('mine', 'Mine')", "it has a REGULATOR of type tuple"),
        (law_text("return omega").replace('"mine"', '"rotation-matrix"'), "the name 'rotation-matrix' is one of ours"),
        (law_text("return omega").replace('"mine"', '"../mine"'), "its name '../mine' is no word"),
        (law_text("return omega").replace('"mine"', "7"), "its name 7 is no word"),
        (law_text("return omega").replace('"Mine"', "7"), "title, source, formula and property must be texts"),
        (law_text("return omega").replace('"u", law', '"u"'), "its law is None"),
        (law_text("return omega").replace('"u", law', '"u", 3.0'), "its law is 3.0"),
        (law_text("return omega").replace("law)", "law, coordinates='any')"), "its law_in is None"),
        (law_text("return omega").replace("law)", "law, coordinates='zyx-euler')"), "its coordinates are 'zyx-euler'"),
        (law_text("return omega").replace("law)", "None, lambda r: law, ('zyx',))"), "representation 'zyx' is unknown"),
        (law_text("return omega").replace("law)", "law, memory=(0, 1))"), "its memory is (0, 1)"),
        (law_text("return omega").replace("law)", "law, memory=(0.0,))"), "law(R, omega, goal, gains, memory)"),
        (law_text("return (1.0, 2.0)"), "returned (1.0, 2.0); it must return a tuple of three floats"),
        (law_text("return [1.0, 2.0, 3.0]"), "returned [1.0, 2.0, 3.0]"),
        (law_text("return ('a', 'b', 'c')"), "returned ('a', 'b', 'c')"),
        (law_text("return None"), "returned None"),
        (law_text("return (0, 0, 0)"), "returned (0, 0, 0)"),
        (law_text("return omega").replace("goal, gains", "goal"), "cannot be called as law(R, omega, goal, gains)"),
        (law_text("return (omega.x, 0.0, 0.0)"), "AttributeError"),
        (law_text("return (speed, 0.0, 0.0)"), "NameError"),
    ],
)
def test_law_file_is_refused_with_the_reason(capsys, finished, tmp_path, text, reason):
    line = refused_run(capsys, finished, "--law", written(tmp_path, text), *TINY)
    assert reason in line


def test_missing_law_file_is_refused(capsys, finished, tmp_path):
    assert "there is no such file" in refused_run(capsys, finished, "--law", tmp_path / "gone.py")


def test_two_law_files_of_one_name_are_refused(capsys, finished, tmp_path):
    one, two = tmp_path / "one.py", tmp_path / "two.py"
    for path in (one, two):
        path.write_text(law_text("return omega"))
    line = refused_run(capsys, finished, "--law", one, "--law", two)
    assert "two --law files name their regulator 'mine'" in line


UNCOMPILABLE = law_text("table = {'a': [str(x) for x in omega]}", "return (-float(table['a'][0]), *omega[1:])")


def test_law_beyond_the_compiler_is_refused_before_anything_is_touched(capsys, finished, tmp_path):
    path = written(tmp_path, UNCOMPILABLE)
    line = refused_run(
        capsys, finished, "--law", path, "--regulator", "mine", "--starts", "paper", "--engine", "native"
    )
    assert "cannot be compiled (" in line
    assert "--engine reference" in line
    assert "float(unicode_type)" in line  # what in the law, not which pass of the compiler


def test_law_beyond_the_compiler_runs_on_the_reference_engine(capsys, tmp_path):
    path = written(tmp_path, UNCOMPILABLE)
    out = tmp_path / "out"
    words = ("--regulator", "mine", "--starts", "paper", "--engine", "reference", "--horizon", "0.1")
    said = bench(capsys, "run", "--law", path, "--out", out, *words)
    assert said.code == 0, said
    assert set(store.read(out, "episodes")["regulator"]) == {"mine"}
    assert "mine" not in set(store.read(out, "costs")["regulator"])


# ------------------------------------------------------------------------------------ folders of results


def test_file_in_place_of_a_results_folder_is_refused(capsys, tmp_path):
    path = tmp_path / "file"
    path.write_text("keep me")
    for out in (path, path / "below"):
        line = refused(capsys, "run", *TINY, "--engine", "reference", "--out", out)
        assert str(out) in line
        assert "choose another" in line
    assert path.read_text() == "keep me"


def test_folder_that_nobody_can_write_is_refused(capsys):
    """Not even root makes a folder in /proc, as in a read-only mount."""
    line = refused(capsys, "run", *TINY, "--engine", "reference", "--out", "/proc/orientation-bench")
    assert "cannot be written" in line
    assert "choose another folder" in line


def test_full_disk_is_one_line_and_leaves_no_file(tmp_path):
    def write(temporary):
        raise OSError(28, "No space left on device")

    with pytest.raises(BadResults, match=r"cannot be written \(No space left on device\); make room"):
        store.write_atomically(tmp_path / "table.parquet", write)
    assert list(tmp_path.iterdir()) == []


def test_foreign_folder_is_refused_even_with_replace(capsys, tmp_path):
    (tmp_path / "holiday.txt").write_text("photos")
    assert "something else than a run of ours" in refused_run(capsys, tmp_path, *TINY)


@pytest.mark.parametrize("content", ['{"steps": 3}', "[1, 2]", "{", ""])
def test_foreign_plan_is_refused_even_with_replace(capsys, tmp_path, content):
    (tmp_path / "plan.json").write_text(content)
    (tmp_path / "episodes.parquet").write_text("somebody's")
    line = refused_run(capsys, tmp_path, *TINY)
    assert "plan.json" in line


def test_other_plan_is_refused_with_the_cure(capsys, finished):
    before = digest(finished)
    line = refused(capsys, "run", "--out", finished, *TINY, "--engine", "reference", "--kp", "50")
    assert "it holds another plan" in line
    assert "--replace" in line
    assert digest(finished) == before


SAME = ("run", *TINY, "--engine", "reference")


def test_finished_run_of_the_same_plan_is_up_to_date(capsys, finished):
    before = digest(finished)
    said = bench(capsys, *SAME, "--out", finished)
    assert (said.code, said.err) == (0, "")
    assert "up to date" in said.out
    assert digest(finished) == before


def cut(path):
    path.write_bytes(path.read_bytes()[:-20])


@pytest.mark.parametrize("command", [("show",), ("claims",), ("compare",), SAME], ids=lambda words: words[0])
def test_truncated_table_is_refused_by_name(capsys, finished, command):
    cut(finished / "episodes.parquet")
    before = digest(finished)
    line = refused(
        capsys, *command, *(("--out",) if command == SAME else ()), finished, *[finished] * (command == ("compare",))
    )
    assert "episodes.parquet" in line
    assert "truncated" in line
    assert digest(finished) == before


def test_deleted_table_is_measured_again_by_the_same_command(capsys, finished):
    before = digest(finished)
    (finished / "episodes.parquet").unlink()
    assert bench(capsys, *SAME, "--out", finished).code == 0
    after = digest(finished)
    assert after.pop("provenance.json") != before.pop("provenance.json")
    assert after == before


def test_truncated_part_is_refused_by_name_before_anything_runs(capsys, finished):
    (finished / "provenance.json").unlink()
    (finished / "parts").mkdir()
    part = finished / "parts" / "reference_rotation-matrix_free-body_paper_000000.parquet"
    shutil.copy(finished / "episodes.parquet", part)
    cut(part)
    before = digest(finished)
    line = refused(capsys, *SAME, "--out", finished)
    assert part.name in line
    assert "delete it and run again" in line
    assert digest(finished) == before


@pytest.mark.parametrize("command", [("show",), SAME], ids=lambda words: words[0])
def test_table_of_another_schema_is_refused_with_both_versions(capsys, finished, command):
    path = finished / "episodes.parquet"
    table = pq.read_table(path)
    pq.write_table(table.replace_schema_metadata({**table.schema.metadata, b"orientation-bench schema": b"0"}), path)
    line = refused(capsys, *command, *(("--out",) if command == SAME else ()), finished)
    assert "its schema is '0', this program reads '1'" in line


def test_table_that_is_no_table_of_ours_is_refused(capsys, finished):
    pq.write_table(pa.table({"x": [1.0]}), finished / "episodes.parquet")
    assert "its schema is 'none'" in refused(capsys, "show", finished)


@pytest.mark.parametrize("content", ["{", "[]", "{}"])
def test_broken_provenance_is_refused_by_name(capsys, finished, content):
    (finished / "provenance.json").write_text(content)
    assert "provenance.json" in refused(capsys, "show", finished)


@pytest.mark.parametrize("command", ["show", "claims", "compare"])
def test_reader_of_a_missing_or_unfinished_run_says_what_to_run(capsys, finished, command):
    second = [finished] * (command == "compare")
    assert "there is no such folder" in refused(capsys, command, finished / "nowhere", *second)
    (finished / "provenance.json").unlink()
    assert "has not finished" in refused(capsys, command, finished, *second)


def test_dry_run_touches_nothing(capsys, finished, tmp_path):
    before = digest(tmp_path)
    for out in (finished, tmp_path / "new", tmp_path / "new" / "deeper"):
        said = bench(capsys, "run", "--dry-run", "--replace", "--kp", "7", *TINY, "--out", out)
        assert (said.code, said.err) == (0, "")
        assert "episodes in" in said.out
    assert digest(tmp_path) == before


def test_folder_named_like_a_partition_is_read_as_it_is(capsys, tmp_path):
    """Arrow would take `kp=7` in a path for a column of that name and value."""
    out = tmp_path / "kp=7"
    assert bench(capsys, *SAME, "--kp", "7", "--out", out).code == 0
    assert set(store.read(out, "episodes")["kp"]) == {7.0}
    assert bench(capsys, "show", out).code == 0
