"""Laws as Python: our vectors where nothing of ours is installed, our bits, and arguments as lists or arrays."""

import subprocess
import sys
from types import ModuleType

import numpy as np
import pytest
from support.exported import ANSWERS, KP, KV, laws, our_answers, states, subjects, written

from bench.export.language import find_language
from bench.export.subject import find_subject

EVERY = 100
"""One state in so many is computed: Python takes some 20 us for each."""

RUN_ALL = """
import runpy, sys
for folder in sys.argv[1:]:
    name = folder.rpartition('/')[2]
    sys.path.insert(0, folder)
    try:
        runpy.run_path(f'{folder}/test_{name}.py')
    except SystemExit as ended:
        print(name, ended.code)
assert not {'bench', 'tasks', 'numba', 'mujoco', 'numpy'} & set(sys.modules)
"""


def loaded(subject) -> ModuleType:
    """Return the exported module."""
    module = ModuleType(subject.identifier)
    exec(find_language("python").law(subject)[1], vars(module))
    return module


def test_vectors_pass_in_python_where_nothing_of_ours_is_installed(tmp_path):
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


@pytest.mark.parametrize("contender", laws(), ids=lambda one: one.name)
def test_law_in_python_gives_our_bits_where_the_command_is_finite(contender):
    subject = find_subject(contender.name)
    law, rows = loaded(subject), states()[::EVERY].tolist()
    ours = our_answers(contender)[::EVERY, : ANSWERS if subject.memory else 3]
    finite = np.isfinite(ours).all(axis=1)
    assert finite.mean() > 0.85  # at 180° and at poles some laws divide by zero
    for row, expected in zip(np.array(rows)[finite].tolist(), ours[finite].tolist(), strict=True):
        R, R_d = ([row[at : at + 3] for at in range(first, first + 9, 3)] for first in (0, 12))
        answer = law.command(R, row[9:12], R_d, KP, KV, *([row[21:]] if subject.memory else []))
        found = [*answer[0], *answer[1]] if subject.memory else list(answer)
        assert list(map(float.hex, found)) == list(map(float.hex, expected))


def test_arrays_of_numpy_are_taken_as_lists_are():
    law = loaded(find_subject("quaternion-shortest"))
    R = loaded(find_subject("representation-quaternion")).rotation([0.0, 0.6, 0.0, 0.8])
    assert law.orientation_error(np.array(R), np.eye(3)) == law.orientation_error(R, np.eye(3).tolist())
    np.testing.assert_allclose(R, [[-0.28, 0.0, 0.96], [0.0, -1.0, 0.0], [0.96, 0.0, 0.28]], atol=1e-15)


def test_other_shape_is_refused():
    law = loaded(find_subject("rotation-matrix"))
    with pytest.raises(ValueError, match="three rows of three numbers"):
        law.orientation_error(np.eye(3), np.ones((3, 4)))
