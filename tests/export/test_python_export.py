"""Laws as Python on NumPy's arrays: our vectors where nothing of ours is installed, our bits, any axes, both floats."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support.exported import ANSWERS, KP, KV, laws, our_answers, states, subjects, written
from support.numpy_export import answered, asked, loaded

from bench.export.subject import find_subject

SITE = Path(np.__file__).parents[1]
RUN_ALL = f"""
import runpy, sys
sys.path.append({str(SITE)!r})  # with -S: NumPy is found there, and nothing that was installed as editable
for folder in sys.argv[1:]:
    name = folder.rpartition('/')[2]
    sys.path.insert(0, folder)
    try:
        runpy.run_path(f'{{folder}}/test_{{name}}.py')
    except SystemExit as ended:
        print(name, ended.code)
assert not {{'bench', 'tasks', 'numba', 'mujoco'}} & set(sys.modules)
"""


@pytest.mark.slow
def test_vectors_pass_in_numpy_where_nothing_of_ours_is_installed(tmp_path):
    folders = [str(written(one, "python", tmp_path)) for one in subjects()]
    (tmp_path / "empty").mkdir()
    words = [sys.executable, "-I", "-S", "-W", "error", "-c", RUN_ALL, *folders]
    ended = subprocess.run(words, cwd=tmp_path / "empty", capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    expected = [line for one in subjects() for line in (f"{one.identifier}: 0 of", f"{one.identifier} 0")]
    found = ended.stdout.splitlines()
    assert len(found) == len(expected)
    assert [line for line, begin in zip(found, expected, strict=True) if not line.startswith(begin)] == []


def test_wrong_answer_is_counted(tmp_path):
    here = written(find_subject("rotation-matrix"), "python", tmp_path)
    path = here / "rotation_matrix.py"
    text = path.read_text()
    assert text.count("0.5 * ") >= 1
    path.write_text(text.replace("0.5 * ", "0.25 * ", 1))
    ended = subprocess.run([sys.executable, "test_rotation_matrix.py"], cwd=here, capture_output=True, text=True)
    assert (ended.returncode, " 0 of " in ended.stdout) == (1, False), ended.stderr


def libm(name: str):
    """That function of libm on every number; NaN outside its domain, as in compiled code."""

    def one(*x: float) -> float:
        return getattr(math, name)(*x) if all(map(math.isfinite, x)) or name == "atan2" else math.nan

    many = np.frompyfunc(one, 2 if name == "atan2" else 1, 1)
    return lambda lanes, *x: np.asarray(many(*map(lanes.safe, x)), dtype=float)


@pytest.mark.parametrize("contender", laws(), ids=lambda one: one.name)
def test_law_in_numpy_gives_our_bits_at_every_state(tmp_path, monkeypatch, contender):
    """With libm's sines, cosines and arcs, as ours have; NumPy's own are another library's."""
    subject = find_subject(contender.name)
    law = loaded(subject, tmp_path)
    for name in ("sin", "cos", "atan2"):
        monkeypatch.setattr(law.Lanes, name, libm(name))
    with np.errstate(all="ignore"):  # at 180° some laws divide by zero, as they do in ours
        theirs = answered(law, asked(subject, states()))
    ours = our_answers(contender)[:, : ANSWERS if subject.memory else 3]
    same = (ours.view(np.uint64) == theirs.view(np.uint64)) | (np.isnan(ours) & np.isnan(theirs))
    assert same.all(), (np.argwhere(~same)[:3], ours[~same][:3], theirs[~same][:3])


SOME = ("late-braking", "rotation-vector", "feedback-linearized/zyx-euler", "weighted-columns")


@pytest.mark.parametrize("word", SOME)
def test_law_over_any_axes_equals_its_states_one_by_one(tmp_path, word):
    subject = find_subject(word)
    law = loaded(subject, tmp_path)
    rows = states()[-24:].reshape(2, 3, 4, -1)
    together = answered(law, asked(subject, rows))
    assert together.shape == (2, 3, 4, ANSWERS if subject.memory else 3)
    # NumPy's vectorised sines may differ in the last bit from those of single numbers: 4 ulp of a command's parts
    slack = 0.0 if word in ("late-braking", "weighted-columns") else 4.0 * np.spacing(10.0 * KP)
    for at in np.ndindex(2, 3, 4):
        np.testing.assert_allclose(together[at], answered(law, asked(subject, rows[at])), rtol=0.0, atol=slack)


def test_goals_gains_and_memory_are_broadcast(tmp_path):
    subject = find_subject("late-braking")
    law = loaded(subject, tmp_path)
    R, omega, R_d, *_ = asked(subject, states()[-6:].reshape(2, 3, -1))
    kp = np.array([50.0, 100.0, 200.0])
    u, memory = law.command(R, omega, R_d[0, 0], kp, 20, law.reset())
    assert (u.shape, memory.shape) == ((2, 3, 3), (2, 3, 4))
    for at in np.ndindex(2, 3):
        one, _ = law.command(R[at], omega[at], R_d[0, 0], float(kp[at[1]]), 20.0, law.reset())
        np.testing.assert_array_equal(u[at], one)


def test_lists_become_numpy_arrays(tmp_path):
    law = loaded(find_subject("quaternion-shortest"), tmp_path)
    e = law.orientation_error_wxyz([1, 0, 0, 0], [0, 1, 0, 0])
    assert (e.dtype, e.tolist()) == (np.float64, [2.0, 0.0, 0.0])


def test_other_shape_is_refused_by_its_name(tmp_path):
    law = loaded(find_subject("rotation-matrix"), tmp_path)
    with pytest.raises(ValueError, match=r"R_d has the shape \(3, 4\); allowed: \(\.\.\., 3, 3\)"):
        law.orientation_error(np.eye(3), np.ones((3, 4)))


@pytest.mark.parametrize("contender", laws(), ids=lambda one: one.name)
def test_float32_stays_float32(tmp_path, contender):
    subject = find_subject(contender.name)
    law = loaded(subject, tmp_path)
    far = states()[-200:]
    given = asked(subject, far)
    short = [one.astype(np.float32) if isinstance(one, np.ndarray) else one for one in given]
    theirs = answered(law, short)
    assert theirs.dtype == np.float32
    # of a law that is steep somewhere half of the states still tell a wrong digit from a rounded one
    off = np.abs(theirs - answered(law, given)).max(axis=1) / (KP + KV * np.abs(far[:, 9:12]).max(axis=1))
    assert np.median(off) < 16.0 * np.finfo(np.float32).eps


def test_every_entry_keeps_float32(tmp_path):
    for subject in subjects():
        law = loaded(subject, tmp_path)
        for entry in subject.entries:
            shapes = {"matrix": (3, 3), "number": ()}
            given = []
            for one in entry.parameters:
                if one.kind == "gains":
                    given += [KP, KV]
                else:
                    shape = (3, 3) if one.size == 9 else shapes.get(one.kind, (one.size,))
                    whole = np.eye(3) if shape == (3, 3) else np.full(shape, 0.5)
                    given.append(whole.astype(np.float32))
            with np.errstate(all="ignore"):
                answer = getattr(law, entry.name)(*given)
            for part in answer if isinstance(answer, tuple) else (answer,):
                assert part.dtype == np.float32, (subject.word, entry.name)
