"""What can be audited, functions, classes, C, by command and by pytest; every mistake has its cure."""

import json
import os
import pty
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support.command_line import bench, refused
from support.users_errors import CALLED, REFUSED

from bench.audit import audit
from bench.audit.faults import every_fault
from bench.audit.load import load
from bench.base.errors import BadFunction, BadNumber, UnknownWord
from bench.base.provenance import ROOT

HERE = Path(__file__).parent


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "my_file.py"
    shutil.copy(HERE / "errors.python", path)
    return path


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    if shutil.which("cc") is None:
        pytest.skip("this machine has no C compiler")
    folder = tmp_path_factory.mktemp("c")
    subprocess.run(
        ["cc", "-shared", "-fPIC", "-O1", "-o", "libmine.so", str(HERE / "errors.c")], cwd=folder, check=True
    )
    return folder / "libmine.so"


@pytest.mark.parametrize("name", ["columns", "Called", "Controller"])
def test_function_and_class_of_a_file_are_asked(file, name):
    report = audit(load(f"{file}:{name}"))
    assert (report.convention.form, report.faults) == ("sine", ("dead-at-180",))


def test_c_function_of_matrices_is_that_of_python(library, file):
    rng = np.random.default_rng(1)
    R, R_d = rng.normal(size=(2, 3, 3))
    ours, theirs = load(f"{file}:columns"), load(f"{library}:columns")
    np.testing.assert_allclose(theirs(R, R_d), ours(R, R_d), rtol=0.0, atol=1e-15)
    assert audit(theirs).convention == audit(ours).convention


def test_c_function_of_quaternions_is_known_for_one_and_its_missing_sign_found(library):
    report = audit(load(f"{library}:vector_part"))
    assert (report.convention.takes, report.convention.form) == ("xyzw", "sine-of-half")
    assert report.faults == ("double-cover",)


@pytest.mark.parametrize(
    ("symbol", "said"), [("lazy", "no e[2]"), ("floats", "no e[2]"), ("error_first", "nothing"), ("beyond", "e[3]")]
)
def test_c_function_of_another_interface_is_named_so_and_nothing_else(library, symbol, said):
    report = audit(load(f"{library}:{symbol}"))
    assert report.faults == ("c-interface",)
    assert f"it wrote {said}" in report.text()


@pytest.mark.parametrize(
    ("target", "said"),
    [
        ("columns", "names no function; give FILE.py:NAME"),
        ("nowhere.py:f", "there is no file nowhere.py"),
        ("nowhere.so:f", "there is no file nowhere.so"),
        ("no_such_module:f", "give FILE.py:NAME, or install the package"),
        ("{file}:colums", "has no 'colums'; it has np, columns"),
        ("{file}:np", "is module, no function"),
        ("{file}:Two", "several (error, torque); give it a __call__(R, R_d)"),
        ("{file}:None_", "none; give it a __call__(R, R_d)"),
        ("{file}:Wants", "give a class that needs no arguments"),
        ("{broken}:f", "does not import (SyntaxError"),
        ("{broken_library}:f", "does not load"),
        ("{library}:missing", "no symbol 'missing'; declare it extern"),
    ],
)
def test_mistake_in_a_name_is_refused_with_its_cure(request, file, target, said):
    library = request.getfixturevalue("library") if "{library}" in target else None
    broken, broken_library = file.parent / "broken.py", file.parent / "broken.so"
    broken.write_text("def f(:")
    broken_library.write_text("no library")
    with pytest.raises(BadFunction) as error:
        load(target.format(file=file, broken=broken, broken_library=broken_library, library=library))
    assert said in str(error.value)


@pytest.mark.parametrize(("code", "function"), CALLED.items())
def test_function_of_other_things_than_arrays_is_called_as_it_wants(code, function):
    report = audit(function, name="f")
    assert (report.code(), report.faults) == (code, ())
    assert f"Called as {code}" in report.text()


@pytest.mark.parametrize(("function", "cure"), REFUSED.values(), ids=REFUSED)
def test_function_of_another_shape_is_refused_with_its_cure(function, cure):
    with pytest.raises(BadFunction, match=r"f returns three numbers neither .*given .*; ") as error:
        audit(function, name="f")
    assert cure in str(error.value)


def test_answer_that_no_array_holds_is_refused_in_its_own_words():
    class Tensor:
        def __array__(self, *_, **__):
            raise RuntimeError("Can't call numpy() on Tensor that requires grad")

    with pytest.raises(BadFunction, match=r"Tensor \(Can't call numpy\(\) on Tensor that requires grad\)"):
        audit(lambda R, R_d: Tensor())


@pytest.mark.parametrize("words", [{"takes": "quat"}, {"frame": "world"}, {"sign": "plus"}, {"allow": ("norm-clop",)}])
def test_unknown_word_is_refused_with_the_known_ones(file, words):
    with pytest.raises(UnknownWord, match="known: "):
        audit(load(f"{file}:columns"), **words)


@pytest.mark.parametrize("limit", ["0", "-1", "nan", "inf", "1e300"])
def test_limit_that_is_no_time_is_refused_before_the_file_is_loaded(capsys, file, limit):
    line = refused(capsys, "audit", f"{file}:columns", "--limit", limit)
    assert "is not a time up to 86400 s, a day (try: --limit 60)" in line


@pytest.mark.parametrize("stiffness", [0.0, -1.0, float("nan"), float("inf")])
def test_stiffness_that_is_not_positive_is_refused(file, stiffness):
    with pytest.raises(BadNumber):
        audit(load(f"{file}:columns"), stiffness=stiffness)


# --------------------------------------------------------------------------- the command


def test_command_ends_with_1_on_a_fault_and_0_if_every_one_is_allowed(capsys, file):
    half, dead, weak = f"{file}:half", ("--allow", "dead-at-180"), ("--allow", "stiffness")
    assert bench(capsys, "audit", half).code == 1
    assert bench(capsys, "audit", half, *dead).code == 1
    assert bench(capsys, "audit", half, *dead, *weak).code == 0
    assert bench(capsys, "audit", half, *dead, "--stiffness", "0.5").code == 0


def test_command_ends_with_1_for_an_error_that_vanishes_at_180_unless_that_is_allowed(capsys, file):
    faulty = bench(capsys, "audit", "check", f"{file}:columns")
    assert (faulty.code, "columns: FAULTS: dead-at-180 (" in faulty.out) == (1, True)
    allowed = bench(capsys, "audit", "check", f"{file}:columns", "--allow", "dead-at-180")
    assert (allowed.code, "columns: no fault found, 1 allowed: dead-at-180 (" in allowed.out) == (0, True)


def test_command_refuses_a_mistake_on_one_line(capsys, file):
    assert "has no 'colums'" in refused(capsys, "audit", "check", f"{file}:colums")
    assert "'world' is unknown" in refused(capsys, "audit", f"{file}:half", "--frame", "world")
    unknown = refused(capsys, "audit", f"{file}:half", "--allow", "dead-at-18")
    assert "'dead-at-18' is unknown" in unknown
    assert all(fault.name in unknown for fault in every_fault())
    assert "(Not a directory); name another file" in refused(capsys, "audit", f"{file}:half", "--json", file / "x.json")


def test_examples_of_the_help_are_words_that_the_command_takes(capsys, file):
    lines = re.findall(r"^   bench (audit check) \S+(.*)", bench(capsys, "audit", "check", "--help").out, re.MULTILINE)
    assert len(lines) == 4
    for command, options in lines:
        assert bench(capsys, *command.split(), f"{file}:chord", *options.split()).code == 0


def test_terminal_sees_the_number_of_calls(file):
    ours, theirs = pty.openpty()
    words = [sys.executable, "-m", "bench", "audit", "check", f"{file}:chord"]
    subprocess.run(words, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=theirs, check=True)
    os.close(theirs)
    assert re.search(rb"[1-9][0-9,]* of about 6,000 calls: ", os.read(ours, 1 << 16))


def test_command_writes_all_of_it_as_json(capsys, file, tmp_path):
    bench(capsys, "audit", f"{file}:vector_part", "--json", tmp_path / "x.json")
    found = json.loads((tmp_path / "x.json").read_text())
    assert found["faults"] == ["double-cover"]
    assert (found["convention"]["takes"], found["convention"]["frame"]) == ("wxyz", "base")
    (finding,) = found["findings"]
    assert len(finding["evidence"]["now"]) == 4


def test_evidence_in_the_text_is_code_that_gives_the_same_answer(capsys, file):
    out = bench(capsys, "audit", f"{file}:half").out
    lines = [line.strip() for line in out.partition("fault stiffness")[2].splitlines()]
    code = [line for line in lines if line.startswith(("R =", "R_d =", "half("))]
    names = {"np": np, "half": load(f"{file}:half")}
    exec("\n".join(code[:2]), names)
    answer, _, said = code[2].partition("  # ")
    np.testing.assert_array_equal(eval(answer, names), eval(said.partition(";")[0]))


pytest_plugins = ("pytester",)


@pytest.fixture
def run(pytester, monkeypatch):
    """run(words of pytest...) in a folder with the functions above and one test."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    pytester.makepyfile(mine=Path(__file__).with_name("errors.python").read_text(), test_one="def test_one(): pass")

    def result(*words):
        return pytester.runpytest("-p", "bench.audit.plugin", "-p", "no:cacheprovider", *words)

    return result


def test_each_fault_is_a_test_beside_the_others(run):
    result = run("--orientation-error", "mine.py:chord", "-v")
    result.assert_outcomes(passed=1 + len(every_fault()))
    result.stdout.fnmatch_lines(["*mine.py:chord[[]dead-at-180[]] PASSED*"])


def test_error_that_vanishes_at_180_fails_unless_an_option_or_the_ini_file_allows_it(run, pytester):
    words = ("--orientation-error", "mine:columns")
    result = run(*words)
    result.assert_outcomes(passed=len(every_fault()), failed=1)
    result.stdout.fnmatch_lines(["fault dead-at-180: *", "*FAILED*mine:columns[[]dead-at-180[]]*"])
    run(*words, "--orientation-error-allow", "dead-at-180").assert_outcomes(passed=1 + len(every_fault()))
    pytester.makeini("[pytest]\norientation_error_allow = dead-at-180\n")
    run(*words).assert_outcomes(passed=1 + len(every_fault()))


def test_unknown_fault_that_is_allowed_is_an_error_of_usage_with_the_known_ones(run):
    result = run("--orientation-error", "mine:columns", "--orientation-error-allow", "dead-at-18")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: *'dead-at-18' is unknown*dead-at-180*"])


def test_fault_fails_its_own_test_and_says_the_cure(run):
    result = run("--orientation-error", "mine:weak_chord")
    result.assert_outcomes(passed=len(every_fault()), failed=1)
    result.stdout.fnmatch_lines(["fault stiffness: *", "*Cure: *", "*FAILED*mine:weak_chord[[]stiffness[]]*"])
    assert run("--orientation-error", "mine:weak_chord", "--orientation-error-allow", "stiffness").ret == 0


def test_mistake_is_an_error_of_usage(run):
    result = run("--orientation-error", "mine.py:colums")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: *has no 'colums'*"])
