"""Exported laws compiled here, all in one library, and the states on which they are held to our own kernels."""

import functools
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from bench.engines.compiled import compile_on_demand
from bench.engines.simulate import evaluation
from bench.export.language import find_language
from bench.export.subject import Subject, find_subject
from bench.law.contender import Contender
from bench.law.inputs import AT_REST, PAPERS_GAINS, Goal, Tuning
from bench.law.so3 import Rotation, from_quaternion

STATES, SOME = 100_000, 20_000
SHAPES = (
    "late-braking",
    "feedback-linearized/zyx-euler",
    "representation-quaternion",
    "spring-logarithm-energy",
)
"""With memory, calling libm, with four coordinates and matrices returned, nine numbers among arguments."""

KP, KV = PAPERS_GAINS
NODE = str(Path(shutil.which("node") or "/usr/bin/node").parent)
LIMITS = 10.0, 0.005
"""Bound and delay of the motors [rad/s^2, s], for a law that reads them."""

WIDTH, ANSWERS = 25, 7
"""Numbers of a state: R, omega, R_d (matrices by rows) and a memory; of an answer: u, and the memory."""


def needs(*tools: str):
    """Skip where a tool is missing, with its cure."""
    absent = [tool for tool in tools if shutil.which(tool) is None]
    return pytest.mark.skipif(
        bool(absent), reason=f"no {', '.join(absent)} here (Debian: apt install gcc g++ nodejs; cargo: rustup.rs)"
    )


def written(subject: Subject, language: str, folder: Path, is_tested: bool = True) -> Path:
    """Write the files of an export, or the law alone without test vectors, into an empty folder of their own."""
    here = folder / language / subject.identifier
    here.mkdir(parents=True)
    chosen = find_language(language)
    for name, text in (chosen.files if is_tested else chosen.law)(subject).items():
        (here / name).parent.mkdir(exist_ok=True)
        (here / name).write_text(text, encoding="utf-8")
    return here


@functools.cache
def states() -> np.ndarray:
    """STATES rows: everywhere, and a tenth each at 180° from the goal, within 1e-8 of that, and at poles."""
    random = np.random.default_rng(1988)
    turn, goal = (_units(random.normal(size=(STATES, 4))) for _ in range(2))
    tenth = STATES // 10
    turn[:tenth, 0] = 0.0
    turn[: tenth // 2, 1:] = np.eye(3)[random.integers(3, size=tenth // 2)]
    goal[: 2 * tenth] = (1.0, 0.0, 0.0, 0.0)
    turn[tenth : 2 * tenth, 0] = 1e-8 * random.normal(size=tenth)
    goal[2 * tenth : 3 * tenth] = (1.0, 0.0, 0.0, 0.0)
    turn[2 * tenth : 3 * tenth] = np.array([1.0, 0.0, 1.0, 0.0]) / np.sqrt(2.0) + 1e-9 * random.normal(size=(tenth, 4))
    omega = random.normal(size=(STATES, 3)) * 10.0 ** random.uniform(-3.0, 1.0, size=(STATES, 1))
    memory = _units(random.normal(size=(STATES, 4)))
    parts = (_by_rows(_units(turn)), omega, _by_rows(_units(goal)), memory)
    return np.ascontiguousarray(np.hstack(parts))


def _units(q: np.ndarray) -> np.ndarray:
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def _by_rows(quat: np.ndarray) -> np.ndarray:
    n, o, a = from_quaternion(tuple(quat.T))
    return np.stack([n[0], o[0], a[0], n[1], o[1], a[1], n[2], o[2], a[2]], axis=1)


@functools.cache
def _ours():
    def loop(evaluate, gains, rows, answers):
        for k in range(rows.shape[0]):
            s = rows[k]
            R = Rotation((s[0], s[3], s[6]), (s[1], s[4], s[7]), (s[2], s[5], s[8]))
            R_d = Rotation((s[12], s[15], s[18]), (s[13], s[16], s[19]), (s[14], s[17], s[20]))
            memory = (s[21], s[22], s[23], s[24])
            u, kept, _ = evaluate(R, (s[9], s[10], s[11]), Goal(R_d, AT_REST, AT_REST), gains, memory)
            answers[k, 0], answers[k, 1], answers[k, 2] = u
            answers[k, 3], answers[k, 4], answers[k, 5], answers[k, 6] = kept

    return compile_on_demand(loop)


def gains_of(subject: Subject) -> tuple[float, ...]:
    """Return the numbers that an exported law takes as its gains: kp and kv, and the limits that a law reads."""
    [gains] = [one for one in subject.entries[0].parameters if one.name == "gains"]
    return (KP, KV, *LIMITS)[: gains.size]


def our_answers(contender: Contender) -> np.ndarray:
    """u and the memory at every state, by the kernel that the engines compile."""
    answers = np.zeros((STATES, ANSWERS))
    _ours()(evaluation(contender), Tuning(KP, KV, *LIMITS), states(), answers)
    return answers


def ask_some(folder: Path, program: str) -> str:
    """Write SOME states into the folder, and return a program that asks at them."""
    (folder / "states").write_bytes(states()[:: STATES // SOME].tobytes())
    numbers = {"WIDTH_OUT": ANSWERS, "COUNT": SOME, "KP": KP, "KV": KV, "FOLDER": folder}
    text = Path(__file__).parents[1].joinpath("export", program).read_text()
    return re.sub("|".join(numbers), lambda word: str(numbers[word[0]]), text)


def assert_same_bits(folder: Path, contender: Contender) -> None:
    """Compare the answers in the folder with those of our kernel."""
    subject = find_subject(contender.name)
    theirs = np.fromfile(folder / f"{subject.identifier}.answers").reshape(SOME, -1)
    ours = our_answers(contender)[:: STATES // SOME, : ANSWERS if subject.memory else 3]
    same = (ours == theirs[:, : ours.shape[1]]) | (np.isnan(ours) & np.isnan(theirs[:, : ours.shape[1]]))
    assert same.all(), (contender.name, np.argwhere(~same)[:3])
