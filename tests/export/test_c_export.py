"""Laws as C and C++: the same bits as our kernels, where nothing of ours is installed; and as many instructions."""

import ctypes
import subprocess
from pathlib import Path

import numpy as np
import pytest
from support.exported import ANSWERS, KP, KV, STATES, WIDTH, laws, needs, our_answers, states, subjects, written

from bench.export.subject import find_subject

NOTHING = {"PATH": "/usr/bin:/bin"}
"""The environment of somebody who has a compiler, and nothing of ours."""

EIGEN = Path("/usr/include/eigen3")
EXACT = ("-O2", "-ffp-contract=off")


def batch(subject) -> str:
    """A function that asks a law's command at many states."""
    has_memory = subject.memory is not None
    copied = "; ".join(f"{{}}[{at}] = {{}}[{at}]" for at in range(4))
    return (
        Path(__file__)
        .with_name("batch.c")
        .read_text()
        .format(
            name=subject.identifier,
            width=WIDTH,
            answers=ANSWERS,
            kp=KP,
            kv=KV,
            before=f"{subject.identifier}_state state; " + copied.format(*["state.memory", "(s + 21)"] * 4) + ";"
            if has_memory
            else "",
            state="&state, " if has_memory else "",
            after=copied.format(*["(answer + 3)", "state.memory"] * 4) + ";" if has_memory else "",
        )
    )


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """All laws in one program of C, which shows that their headers can be included together."""
    folder = tmp_path_factory.mktemp("library")
    found = [find_subject(one.name) for one in laws()]
    lines = []
    for one in found:
        here = written(one, "c", folder)
        lines += [f'#include "{here / one.identifier}.h"', batch(one)]
    (folder / "all.c").write_text("\n".join(lines))
    warnings = ("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wno-unused-function")
    subprocess.run(
        ["gcc", *warnings, *EXACT, "-shared", "-fPIC", "-o", "all.so", "all.c", "-lm"], cwd=folder, check=True
    )
    return ctypes.CDLL(str(folder / "all.so"))


@needs("gcc")
@pytest.mark.parametrize("contender", laws(), ids=lambda one: one.name)
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


@needs("gcc")
def test_vectors_pass_in_c_where_nothing_of_ours_is_installed(tmp_path):
    for one in subjects():
        here = written(one, "c", tmp_path)
        words = ["gcc", "-std=c99", "-O0", "-ffp-contract=off", "-o", "test", f"test_{one.identifier}.c", "-lm"]
        subprocess.run(words, cwd=here, env=NOTHING, check=True)
        ended = subprocess.run(["./test"], cwd=here, env=NOTHING, capture_output=True, text=True)
        assert (ended.returncode, " 0 of " in ended.stdout) == (0, True), (one.word, ended.stdout)


IN_CPP = (
    "late-braking",
    "feedback-linearized/zyx-euler",
    "representation-quaternion",
    "impedance-geometric",
    "compensator-integral",
    "spring-logarithm-energy",
    "spring-log-pose",
)
"""With memory, calling libm, with four coordinates and matrices returned, a number and nine numbers among arguments."""


@needs("g++")
@pytest.mark.skipif(not EIGEN.is_dir(), reason="no Eigen here (Debian: apt install libeigen3-dev)")
@pytest.mark.parametrize("word", IN_CPP)
def test_vectors_pass_in_cpp_where_nothing_of_ours_is_installed(tmp_path, word):
    subject = find_subject(word)
    here = written(subject, "cpp", tmp_path)
    words = ["g++", "-std=c++17", "-O0", "-ffp-contract=off", "-Wall", "-Wextra", f"-isystem{EIGEN}", "-o", "test"]
    subprocess.run([*words, f"test_{subject.identifier}.cpp"], cwd=here, env=NOTHING, check=True)
    ended = subprocess.run(["./test"], cwd=here, env=NOTHING, capture_output=True, text=True)
    assert (ended.returncode, " 0 of " in ended.stdout) == (0, True), ended.stdout


@needs("g++")
@pytest.mark.skipif(not EIGEN.is_dir(), reason="no Eigen here (Debian: apt install libeigen3-dev)")
def test_every_header_in_cpp_compiles_beside_all_others(tmp_path):
    headers = [written(one, "cpp", tmp_path) / f"{one.identifier}.hpp" for one in subjects()]
    (tmp_path / "all.cpp").write_text("\n".join(f'#include "{one}"' for one in headers))
    words = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", f"-isystem{EIGEN}", "-fsyntax-only", "all.cpp"]
    subprocess.run(words, cwd=tmp_path, check=True)


@needs("gcc")
@pytest.mark.parametrize(
    ("word", "right", "wrong"),
    [("rotation-matrix", "0.5 * ", "0.25 * "), ("hybrid", "state->memory[1] = 0.0;", "")],
)
def test_wrong_answer_is_counted(tmp_path, word, right, wrong):
    subject = find_subject(word)
    here = written(subject, "c", tmp_path)
    header = here / f"{subject.identifier}.h"
    text = header.read_text()
    assert text.count(right) >= 1
    header.write_text(text.replace(right, wrong, 1))
    subprocess.run(["gcc", "-o", "test", f"test_{subject.identifier}.c", "-lm"], cwd=here, check=True)
    ended = subprocess.run(["./test"], cwd=here, capture_output=True, text=True)
    assert (ended.returncode, " 0 of " in ended.stdout) == (1, False)
