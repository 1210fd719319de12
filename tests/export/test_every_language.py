"""Laws as C, C++, JavaScript and Python: the bits of our kernels, where nothing of ours is installed."""

import ctypes
import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.exported import (
    ANSWERS,
    KP,
    KV,
    NODE,
    SHAPES,
    STATES,
    WIDTH,
    ask_some,
    assert_same_bits,
    gains_of,
    needs,
    our_answers,
    states,
    written,
)

from bench.export.language import find_language
from bench.export.subject import find_subject, subject_words, translated
from bench.law.contenders.registry import all_contenders

EIGEN = Path("/usr/include/eigen3")
INTO = "-O0 -ffp-contract=off -o test"
COMMANDS = {
    "c": (f"gcc -std=c99 {INTO} test_NAME.c -lm", "./test"),
    "cpp": (f"g++ -std=c++17 -Wall -Wextra -isystem{EIGEN} {INTO} test_NAME.cpp", "./test"),
    "js": ("node test_NAME.js",),
    "python": (f"{sys.executable} -E -S -W error test_NAME.py",),
}
"""Language -> what somebody runs who has the language, and nothing of ours."""


def run_test(here, language, name):
    """Return the exit code of an export's own test, whether it counts no wrong answer, and what it prints."""
    for words in COMMANDS[language]:
        ended = subprocess.run(
            words.replace("NAME", name).split(),
            cwd=here,
            env={"PATH": f"/usr/bin:/bin:{NODE}"},
            capture_output=True,
            text=True,
        )
    return ended.returncode, " 0 of " in ended.stdout, ended.stdout + ended.stderr


HAS_EIGEN = pytest.mark.skipif(not EIGEN.is_dir(), reason="no Eigen here (Debian: apt install libeigen3-dev)")
EXACT = ("-O2", "-ffp-contract=off")


def batch(subject) -> str:
    """A function that asks a law's command at many states."""
    copied = "; ".join(f"{{}}[{at}] = {{}}[{at}]" for at in range(4)) + ";"
    own = dict.fromkeys(("first", "state", "last"), "")
    if subject.memory is not None:
        first = copied.format(*[f"state.{subject.memory_name}", "(s + 21)"] * 4)
        last = copied.format(*["(answer + 3)", f"state.{subject.memory_name}"] * 4)
        own = {"first": f"{subject.identifier}_state state; {first}", "state": "&state, ", "last": last}
    text = Path(__file__).with_name("batch.c").read_text()
    gains = ", ".join(map(repr, gains_of(subject)))
    return text.format(name=subject.identifier, width=WIDTH, answers=ANSWERS, gains=gains, **own)


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """All laws in one program of C, which shows that their headers can be included together."""
    folder = tmp_path_factory.mktemp("library")
    lines = []
    for one in (find_subject(one.name) for one in all_contenders()):
        here = written(one, "c", folder, is_tested=False)
        lines += [f'#include "{here / one.identifier}.h"', batch(one)]
    (folder / "all.c").write_text("\n".join(lines))
    warnings = ("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wno-unused-function")
    subprocess.run(
        ["gcc", *warnings, *EXACT, "-shared", "-fPIC", "-o", "all.so", "all.c", "-lm"], cwd=folder, check=True
    )
    return ctypes.CDLL(str(folder / "all.so"))


@needs("gcc")
@pytest.mark.parametrize("contender", all_contenders())
def test_law_in_c_gives_our_bits_at_every_state(library, contender):
    subject = find_subject(contender.name)
    answers = np.zeros((STATES, ANSWERS))
    pointer = ctypes.POINTER(ctypes.c_double)
    given = (one.ctypes.data_as(pointer) for one in (states(), answers))
    getattr(library, f"{subject.identifier}_batch")(*given, ctypes.c_long(STATES))
    ours = our_answers(contender)[:, : ANSWERS if subject.memory else 3]
    theirs = answers[:, : ours.shape[1]]
    same = (ours.view(np.uint64) == theirs.view(np.uint64)) | (np.isnan(ours) & np.isnan(theirs))
    assert same.all(), (np.argwhere(~same)[:3], ours[~same][:3], theirs[~same][:3])


@pytest.mark.parametrize(
    ("word", "names"),
    [
        ("late-braking", {"memory_wxyz"}),
        ("hybrid", {"memory_wxyz"}),
        ("mrp-linearized", {"memory_wxyz"}),
        ("synergistic", {"memory"}),
        ("compensator-integral", {"state", "state_next"}),
        ("compensator-velocity-free", {"state_wxyz", "state_next_wxyz"}),
        ("representation-quaternion", {"E_wxyz", "Edot_wxyz", "Eddot_wxyz", "F_wxyz"}),
    ],
)
def test_quaternions_and_they_alone_have_their_order_in_the_name(word, names):
    found = {one.name for entry in find_subject(word).entries for one in (*entry.parameters, entry.returns)}
    assert {name for name in found if name.endswith("_wxyz") or name.startswith(("memory", "state"))} == names


@pytest.mark.parametrize("step", [8, pytest.param(1, marks=pytest.mark.weekly)])
@pytest.mark.parametrize(
    "language",
    [
        pytest.param("c", marks=needs("gcc")),
        pytest.param("cpp", marks=[needs("g++"), HAS_EIGEN]),
        pytest.param("js", marks=needs("node")),
        "python",
    ],
)
def test_vectors_pass_where_nothing_of_ours_is_installed(tmp_path, language, step):
    """Try some alone: all laws are held to our bits in C and Python here, and all headers are compiled."""
    for one in map(find_subject, SHAPES if language == "cpp" else {*SHAPES, *subject_words()[::step]}):
        code, is_right, said = run_test(written(one, language, tmp_path), language, one.identifier)
        assert (code, is_right) == (0, True), (one.word, said)


@pytest.mark.parametrize(
    ("language", "word", "right", "wrong"),
    [
        pytest.param("c", "rotation-matrix", "0.5 * ", "0.25 * ", marks=needs("gcc")),
        pytest.param("c", "hybrid", "state->memory_wxyz[1] = 0.0;", "", marks=needs("gcc")),
        ("python", "rotation-matrix", "0.5 * ", "0.25 * "),
    ],
)
def test_wrong_answer_is_counted(tmp_path, language, word, right, wrong):
    subject = find_subject(word)
    here = written(subject, language, tmp_path)
    path = here / f"{subject.identifier}.{'h' if language == 'c' else 'py'}"
    text = path.read_text()
    assert text.count(right) >= 1
    path.write_text(text.replace(right, wrong, 1))
    assert run_test(here, language, subject.identifier)[:2] == (1, False)


@needs("g++")
@HAS_EIGEN
@pytest.mark.parametrize("step", [4, pytest.param(1, marks=pytest.mark.weekly)])
def test_every_header_in_cpp_compiles_beside_all_others(tmp_path, step):
    found = map(find_subject, subject_words()[::step])
    headers = [written(one, "cpp", tmp_path, is_tested=False) / f"{one.identifier}.hpp" for one in found]
    (tmp_path / "all.cpp").write_text("\n".join(f'#include "{one}"' for one in headers))
    words = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", f"-isystem{EIGEN}", "-fsyntax-only", "all.cpp"]
    subprocess.run(words, cwd=tmp_path, check=True)


@needs("node")
def test_algebraic_laws_give_our_bits_in_node(tmp_path):
    found = [(one, find_subject(one.name)) for one in all_contenders()]
    algebraic = [(one, subject) for one, subject in found if translated(subject).is_algebraic]
    assert len(algebraic) >= 12
    laws = {subject.identifier: gains_of(subject) for _, subject in algebraic}
    for _, subject in algebraic:
        written(subject, "js", tmp_path, is_tested=False)
    (tmp_path / "laws.json").write_text(json.dumps(laws))
    (tmp_path / "ask.js").write_text(ask_some(tmp_path, "ask.js"))
    subprocess.run(["node", "ask.js"], cwd=tmp_path, check=True)
    for contender, _ in algebraic:
        assert_same_bits(tmp_path, contender)


@needs("node")
@pytest.mark.parametrize("way", ["require", "import", "script"])
def test_script_loads_in_every_way(tmp_path, way):
    here = written(find_subject("late-braking"), "js", tmp_path)
    said = "console.log(Object.keys(law).length, law.reset().memory_wxyz.length)"
    text = {
        "require": f"const law = require('./late_braking.js'); {said}",
        "import": f"import law from './late_braking.js'; {said}",
        # what a script element does: the text is run as it is, where there is no module
        "script": "const vm = require('vm'), fs = require('fs'), page = vm.createContext({});"
        f"vm.runInContext(fs.readFileSync('late_braking.js', 'utf8'), page); const law = page.late_braking; {said}",
    }[way]
    name = "try.mjs" if way == "import" else "try.js"
    (here / name).write_text(text)
    ended = subprocess.run(["node", name], cwd=here, capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["9", "4"]


EVERY = 100
"""One state in so many is computed: Python takes some 20 us for each."""


def loaded(subject) -> ModuleType:
    """Return the exported module."""
    module = ModuleType(subject.identifier)
    exec(next(iter(find_language("python").law(subject).values())), vars(module))
    return module


@pytest.mark.parametrize("contender", all_contenders())
def test_law_in_python_gives_our_bits_where_its_answer_is_finite(contender):
    subject = find_subject(contender.name)
    law, gains, rows = loaded(subject), gains_of(subject), states()[::EVERY].tolist()
    ours = our_answers(contender)[::EVERY, : ANSWERS if subject.memory else 3]
    finite = np.isfinite(ours).all(axis=1)
    assert finite.mean() > 0.85  # at 180° and at poles some laws divide by zero
    for row, expected in zip(np.array(rows)[finite].tolist(), ours[finite].tolist(), strict=True):
        R, R_d = ([row[at : at + 3] for at in range(first, first + 9, 3)] for first in (0, 12))
        answer = law.angular_acceleration(R, row[9:12], R_d, *gains, *([row[21:]] if subject.memory else []))
        found = [*answer[0], *answer[1]] if subject.memory else list(answer)
        assert list(map(float.hex, found)) == list(map(float.hex, expected))


def test_arrays_of_numpy_are_taken_as_lists_are_and_another_shape_is_refused():
    law = loaded(find_subject("quaternion-shortest"))
    R = loaded(find_subject("representation-quaternion")).rotation([0.0, 0.6, 0.0, 0.8])
    assert law.orientation_error(np.array(R), np.eye(3)) == law.orientation_error(R, np.eye(3).tolist())
    np.testing.assert_allclose(R, [[-0.28, 0.0, 0.96], [0.0, -1.0, 0.0], [0.96, 0.0, 0.28]], atol=1e-15)
    with pytest.raises(ValueError, match="three rows of three numbers"):
        law.orientation_error(np.eye(3), np.ones((3, 4)))


def test_tracking_acceleration_adds_the_motion_of_the_goal_in_both_frames():
    law, random = loaded(find_subject("rotation-vector")), np.random.default_rng(7)
    R, R_d = (Rotation.random(random_state=seed).as_matrix() for seed in (1, 2))
    omega, omega_d, alpha_d = random.normal(size=(3, 3))
    expected = alpha_d + np.cross(omega_d, omega - omega_d) + law.angular_acceleration(R, omega - omega_d, R_d, KP, KV)
    found = law.tracking_acceleration(R, omega, R_d, omega_d, alpha_d, KP, KV)
    np.testing.assert_allclose(found, expected, rtol=1e-12)
    in_body = (R.T @ each for each in (omega, omega_d, alpha_d))
    given = [R, next(in_body), R_d, *in_body, KP, KV]
    np.testing.assert_allclose(law.tracking_acceleration_body(*given), R.T @ expected, rtol=1e-12)
