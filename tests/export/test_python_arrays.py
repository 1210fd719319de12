"""Laws as Python on the arrays of JAX and torch: NumPy's commands, and slopes that NumPy's differences confirm.

JAX has an environment of its own (`make .venv-arrays/.made`). torch is not locked: for Linux its packages on PyPI bring
CUDA, some 5 GB; where it is installed in that environment by hand, it is tested too (torch 2.14.1 passed).
"""

import functools
import json
import subprocess

import numpy as np
import pytest
from support import array_library
from support.exported import laws, states
from support.numpy_export import answered, asked, loaded

from bench.export.languages.python import module
from bench.export.subject import find_subject
from bench.provenance import ROOT

PYTHON = ROOT / ".venv-arrays" / "bin" / "python"
CURES = {"jax": "make .venv-arrays/.made", "torch": "make .venv-arrays/.made, then its pip install torch"}
FEW = 16
ULP = float(np.finfo(float).eps)


@functools.cache
def has(library: str) -> bool:
    """Whether the environment is there, and the library in it."""
    words = [PYTHON, "-c", f"import {library}"]
    return PYTHON.exists() and subprocess.run(words, capture_output=True).returncode == 0


@functools.cache
def rows() -> np.ndarray:
    """Uniform states within 170° of the goal: beyond, what divides by the distance to 180° loses digits anywhere."""
    far = states()[-2 * FEW :]
    trace = np.einsum("ki,ki->k", far[:, :9], far[:, 12:21])
    return far[trace > 1.0 + 2.0 * np.cos(np.radians(170.0))][:FEW]


def at_goal_and_180() -> np.ndarray:
    """Two states where a side that is not taken divides by zero: at the goal, and at 180° from it about x."""
    found = rows()[:2].copy()
    found[:, :9] = np.array([np.eye(3), np.diag([1.0, -1.0, -1.0])]).reshape(2, 9)
    found[:, 12:21] = np.eye(3).ravel()
    return found


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """By library, what every law answers."""

    @functools.cache
    def ask(library: str) -> dict:
        if not has(library):
            pytest.skip(f"no {library} here: {CURES[library]}")
        folder = tmp_path_factory.mktemp(library)
        (folder / "laws").mkdir()
        for one in laws():
            subject = find_subject(one.name)
            (folder / "laws" / f"{subject.identifier}.py").write_text(module(subject), encoding="utf-8")
        R, omega, R_d, _, _, memory = asked(find_subject("late-braking"), np.vstack((rows(), at_goal_and_180())))
        given = {"R": R, "omega": omega, "R_d": R_d, "memory": memory}
        (folder / "states.json").write_text(json.dumps({name: one.tolist() for name, one in given.items()}))
        words = [PYTHON, "-I", "-W", "error", array_library.__file__, library, folder]
        return json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)

    return ask


LIBRARIES = pytest.mark.parametrize("library", sorted(CURES))
EVERY_LAW = pytest.mark.parametrize("contender", laws(), ids=lambda one: one.name)


@EVERY_LAW
@LIBRARIES
def test_command_is_numpy_s_within_a_few_last_bits(tmp_path, answers, library, contender):
    subject = find_subject(contender.name)
    found = answers(library)[subject.identifier]
    expected = answered(loaded(subject, tmp_path), asked(subject, rows()))[:, :3]
    size = np.abs(expected).max(axis=1)
    for way in found.keys() - {"by_R", "by_omega"}:
        # compiled, products are fused with sums: measured up to 5 of the largest part's last bits
        off = np.abs(np.array(found[way])[:FEW] - expected).max(axis=1)
        assert (off <= 32.0 * ULP * size).all(), (way, (off / size / ULP).max())


@EVERY_LAW
@LIBRARIES
def test_slopes_are_those_of_numpy_s_differences(tmp_path, answers, library, contender):
    subject = find_subject(contender.name)
    found, law = answers(library)[subject.identifier], loaded(subject, tmp_path)
    by_R, by_omega = np.array(found["by_R"])[:FEW], np.array(found["by_omega"])[:FEW]
    random = np.random.default_rng(1988)
    R, omega, *others = asked(subject, rows())
    dR, domega, step = random.normal(size=R.shape), random.normal(size=omega.shape), 1e-6
    ends = [answered(law, [R + h * dR, omega + h * domega, *others])[:, :3].sum(axis=1) for h in (-step, step)]
    slope = (by_R * dR).sum(axis=(1, 2)) + (by_omega * domega).sum(axis=1)
    assert np.isfinite(slope).all()
    # central differences: rounding over the step is 1e-10 of the command; measured 1e-9
    np.testing.assert_allclose((ends[1] - ends[0]) / (2.0 * step), slope, rtol=1e-6, atol=1e-5)


FINITE = ("rotation-vector", "feedback-linearized/rotation-vector", "late-braking", "square-root", "mrp", "sliding")
"""Laws with branches, and with a command and a slope at the goal and at 180°."""


@pytest.mark.parametrize("word", FINITE)
@LIBRARIES
def test_slopes_are_finite_where_a_side_not_taken_divides_by_zero(answers, library, word):
    found = answers(library)[find_subject(word).identifier]
    assert all(np.isfinite(np.array(found[name])[FEW:]).all() for name in ("by_R", "by_omega"))
