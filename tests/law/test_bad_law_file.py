"""A law file of a user's: known by its words; one that cannot be used is refused in one line, nothing touched."""

from pathlib import Path

import pytest
from support.command_line import TINY, bench, refused, refused_run
from support.user_law import law_text

from bench.experiments.tables import store
from bench.law.contenders.described_law import described, fields_of
from bench.law.contenders.law_file import load_law


def written(folder: Path, text: str) -> Path:
    path = folder / "own.py"
    path.write_text(text)
    return path


def with_fields(fields: str) -> str:
    """Return a sound law with more fields in its record."""
    return law_text("return omega").replace("law)", f"law, {fields})").replace("import Law", "import Display, Law")


def on_coordinates(fields: str) -> str:
    """Return a law on coordinates, by these fields."""
    text = law_text("return omega").replace("law)", f"OnCoordinates({fields}))")
    return text.replace("import Law", "import Law, OnCoordinates")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("def law(:", "does not import (SyntaxError"),
        ("import no_such_thing", "does not import (ModuleNotFoundError in line 1: No module named 'no_such_thing')"),
        ("raise RuntimeError('on\\npurpose')", "does not import (RuntimeError in line 1: on purpose)"),
        ("from bench.law import Regulator", "bench.law.Regulator is now Law; write: from bench.law import Law"),
        ("x = 1", "it has no REGULATOR; it needs a constant REGULATOR"),
        ("REGULATOR = 5", "it has a REGULATOR of type int"),
        ("REGULATOR = ('mine', 'Mine')", "it has a REGULATOR of type tuple"),
        (law_text("return omega").replace('"mine"', '"rotation-matrix"'), "the name 'rotation-matrix' is one of ours"),
        (law_text("return omega").replace('"mine"', '"../mine"'), "its name '../mine' is no word"),
        (law_text("return omega").replace('"mine"', "7"), "its name 7 is no word"),
        (law_text("return omega").replace('"Mine"', "7"), "title, source, formula and property must be texts"),
        (with_fields("display=Display('$x$')"), "its short name and family are ('$x$', '')"),
        (with_fields("display=Display(look=('red', 'o', '-'))"), "its look is ('red', 'o', '-')"),
        (with_fields("display=Display(equation=3.0)"), "give a bench.law.Equation(formula, spring)"),
        (law_text("return omega").replace('"u", law', '"u"'), "its law is None"),
        (law_text("return omega").replace('"u", law', '"u", 3.0'), "its law is 3.0"),
        (with_fields("coordinates='any'"), "its law_in is None"),
        (with_fields("coordinates='zyx-euler'"), "its coordinates are 'zyx-euler'"),
        (
            law_text("return omega").replace("law)", "None, lambda r: law, coordinates=('zyx',))"),
            "representation 'zyx' is unknown",
        ),
        (with_fields("relative=True"), "write it in law=OnCoordinates(law_in, coordinates, ...)"),
        (on_coordinates("None, 'any'"), "its law_in is None"),
        (on_coordinates("lambda r: law, 'zyx-euler'"), "its coordinates are 'zyx-euler'"),
        (on_coordinates("lambda r: law, ('zyx',)"), "representation 'zyx' is unknown"),
        (with_fields("memory=(0, 1)"), "its memory is (0, 1)"),
        (with_fields("memory=(0.0,)"), "law(R, omega, goal, gains, memory)"),
        (with_fields("in_engine=True"), "MuJoCo's own actuator would run"),
        (with_fields("role='actuator'"), "its role is 'actuator'; omit it"),
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
    path = written(tmp_path, text)
    line = refused_run(capsys, finished, "--law", path, *TINY)
    assert reason in line
    assert refused(capsys, "judge", path) == line


OLD = """
from bench.contender import Regulator
from bench.scalar import kernel, sqrt
from bench.so3 import (cross,
    dot)
"""


def test_imports_of_before_the_public_face_are_refused_with_the_line_to_write(capsys, finished, tmp_path):
    line = refused_run(capsys, finished, "--law", written(tmp_path, OLD), *TINY)
    assert "No module named 'bench.contender'" in line
    assert line.endswith("write: from bench.law import Law, cross, dot, kernel, sqrt")


def test_former_name_of_a_field_is_accepted_with_a_note(capsys, tmp_path):
    path = written(tmp_path, with_fields("later=True"))
    assert described(path).is_beyond_the_paper
    said = bench(capsys, "list", "regulators", "--law", path)
    assert said.code == 0
    assert said.err.count("write is_beyond_the_paper= in place of later=") == 1


@pytest.mark.parametrize(
    "text",
    [
        with_fields("is_beyond_the_paper=True"),
        # A mark of the coding at the beginning, as some editors write it.
        "\ufeff" + with_fields("is_beyond_the_paper=True"),
        # A call of another function than Law.
        with_fields("is_beyond_the_paper=True") + "\nREST = dict(later=True)\n",
    ],
    ids=["plain", "byte-order-mark", "another-call"],
)
def test_law_file_with_the_names_of_today_has_no_note(capsys, tmp_path, text):
    said = bench(capsys, "list", "regulators", "--law", written(tmp_path, text))
    assert (said.code, said.err) == (0, "")


def test_missing_law_file_is_refused(capsys, finished, tmp_path):
    assert "there is no such file" in refused_run(capsys, finished, "--law", tmp_path / "gone.py")


def test_two_law_files_of_one_name_are_refused(capsys, finished, tmp_path):
    one, two = tmp_path / "one.py", tmp_path / "two.py"
    for path in (one, two):
        path.write_text(law_text("return omega"))
    line = refused_run(capsys, finished, "--law", one, "--law", two)
    assert "two --law files name their regulator 'mine'" in line


UNCOMPILABLE = law_text("table = {'a': [str(x) for x in omega]}", "return (-float(table['a'][0]), *omega[1:])")


def test_law_beyond_the_compiler_is_refused_with_nothing_touched_and_runs_on_the_reference(capsys, finished, tmp_path):
    path = written(tmp_path, UNCOMPILABLE)
    line = refused_run(
        capsys, finished, "--law", path, "--regulator", "mine", "--starts", "paper", "--engine", "native"
    )
    assert "cannot be compiled: " in line
    assert "bench run --engine reference" in line
    assert "[str(x) for x in omega]" in line  # what in the law, not which pass of the compiler
    out = tmp_path / "out"
    words = ("--regulator", "mine", "--starts", "paper", "--engine", "reference", "--horizon", "0.1")
    said = bench(capsys, "run", "--law", path, "--out", out, *words)
    assert said.code == 0, said
    assert set(store.read(out, "episodes")["regulator"]) == {"mine"}
    assert "mine" not in set(store.read(out, "costs")["regulator"])


SOUND = law_text("return (-kp * R.n[0], 0.0, 0.0)").replace("kp *", "gains.kp *")


@pytest.mark.parametrize(
    "more",
    [
        "",
        ", display=Display('own', Look('sky', 'h', 'dotted'), 'Mine'), property='local', stiffness=(1.0, 0.5, 1.0)",
        ", memory=(1.0, 0.0)",
    ],
)
def test_words_of_a_law_are_those_of_its_file(tmp_path, more):
    text = SOUND.replace("law)", f"law{more})").replace("import Law", "import Display, Law, Look")
    if "memory" in more:
        text = text.replace("goal, gains)", "goal, gains, memory)").replace("0.0, 0.0)\n", "0.0, 0.0), memory\n")
    path = written(tmp_path, text)
    own = described(path)
    assert fields_of(own) == fields_of(load_law(path))
    assert own.origin == str(path)
    with pytest.raises(RuntimeError, match="in its sandbox alone"):
        own.law()


@pytest.mark.parametrize("body", ["raise ValueError('no')", "while R.n[0] < 2.0: x = 1.0", "os._exit(0)"])
def test_law_that_does_not_answer_is_known_all_the_same(tmp_path, body):
    text = law_text(body, "return omega")
    assert described(written(tmp_path, f"import os\n{text}"), limit_s=2.0, waits_s=5.0).name == "mine"
