"""`export`: what it writes and says, and what it refuses."""

import subprocess
import sys

import pytest
from support.command_line import bench, refused
from support.exported import needs
from support.user_law import law_text

from bench.export.language import language_words

LOOPING = """
WEIGHTS = (0.8, 1.0, 1.2)

@kernel
def spring(R, R_d):
    total = 0.0
    for k in range(1, 3):
        total -= WEIGHTS[k] * R.n[k] - R_d.n[k]
    x, y = R.o[2], R.a[1]
    x, y = y, x
    return (total, x - y, -(x - (y - total)))

@kernel
"""
"""A constant, a loop, a difference of differences, and two names that change places."""


@pytest.mark.parametrize("language", language_words())
def test_export_writes_law_test_vectors_and_how_to_try_them(capsys, tmp_path, language):
    said = bench(capsys, "export", "rotation-matrix", "--to", language, "--out", str(tmp_path / "here"))
    assert (said.code, "try it there" in said.out) == (0, True)
    names = sorted(path.name for path in (tmp_path / "here").iterdir())
    assert len(names) == (5 if language == "c" else 6)
    assert {"LICENSE", "README.md", "vectors.json"} < set(names)


@pytest.mark.parametrize(
    ("language", "run"),
    [
        ("python", f"{sys.executable} test_mine.py"),
        pytest.param("c", "gcc -o test test_mine.c -lm && ./test", marks=needs("gcc")),
    ],
)
def test_export_of_a_user_s_law_is_of_its_file(capsys, tmp_path, language, run):
    (tmp_path / "mine.py").write_text(law_text("u = spring(R, goal.R)", "return u").replace("@kernel", LOOPING, 1))
    words = ("export", "mine", "--law", str(tmp_path / "mine.py"), "--to", language, "--out", str(tmp_path / "out"))
    said = bench(capsys, *words)
    assert said.code == 0, said.err
    assert subprocess.run(run, shell=True, cwd=tmp_path / "out").returncode == 0


@pytest.mark.parametrize(
    ("words", "cure"),
    [
        (("late-brakin", "--to", "c"), "did you mean 'late-braking'"),
        (("late-braking", "--to", "ada"), ", ".join(language_words())),
        (("late-braking", "--to", "c++"), "did you mean 'cpp'"),
        (("pose-spring-geometric", "--to", "c"), "impedance-geometric"),
        (("feedback-linearized", "--to", "c"), "feedback-linearized/zyx-euler, feedback-linearized/zyz-euler"),
        (("representation-euler", "--to", "c"), "zyx-euler"),
    ],
)
def test_export_refuses_what_is_not_there_with_the_cure(capsys, words, cure):
    said = bench(capsys, "export", *words)
    assert (said.code, cure in said.err) == (2, True), said.err


@pytest.mark.parametrize("used", ["omega[0] ** 2", "omega[0] // 2.0", "5 % 3"])
def test_operator_that_other_languages_lack_is_refused_with_what_is_allowed(capsys, tmp_path, used):
    (tmp_path / "mine.py").write_text(law_text(f"return (gains.kp * ({used}), 0.0, 0.0)"))
    line = refused(capsys, "export", "mine", "--law", tmp_path / "mine.py", "--to", "c", "--out", tmp_path / "out")
    assert f"`{used}` has the operator {used.split()[1]}, which cannot be exported; allowed: + - * /" in line


def test_export_into_what_is_no_folder_is_refused(capsys, tmp_path):
    (tmp_path / "file").write_text("")
    words = ("export", "rotation-matrix", "--to", "c", "--out", tmp_path / "file")
    assert "choose another folder" in refused(capsys, *words)
