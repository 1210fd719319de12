"""What is printed wrongly in Murphy 1988 (errata.toml), each with its check, and what no run decides (untestable.toml).

coverage.toml: what each numbered equation and figure says, its claims, and its subjects.

Where a check can be computed it is the function `check_` and the erratum's id, which returns True if it is confirmed;
the others are by reading.
"""

import math
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bench.experiments.probe_values.coordinates import ABOUT_Y
from bench.findings.claims.verdict import read_texts
from bench.findings.subjects import SentenceSubject
from bench.findings.theory.compliance_theory import matrix_B
from bench.law.contenders.registry import representation
from bench.law.inputs import Gains
from bench.law.so3 import from_quaternion

TINY = 1e-12
RATES = (0.3, -0.7, 0.5)
"""Any rates of alpha, beta, gamma [rad/s]."""


class Erratum(NamedTuple):
    """One misprint. printed: as it stands, shortened. right: what should stand. how: what shows it."""

    id: str
    where: str
    printed: str
    right: str
    how: str
    check: Callable[[], bool] | None = None


class Item(NamedTuple):
    """A part of the paper: its number or place, what it says, claims and errata on it, and its subjects."""

    paper: str
    says: str
    claims: tuple[str, ...]
    subjects: tuple[SentenceSubject, ...]


ZYX = representation("zyx-euler")


def check_E01() -> bool:
    """B is regular at 180 degrees about Y and singular at 90."""
    matrices = [matrix_B(ZYX, from_quaternion(ABOUT_Y[degrees])) for degrees in (180, 90)]
    half, quarter = np.linalg.svd(matrices, compute_uv=False)[:, -1]
    return bool(half > 0.5 and quarter < TINY)


def check_E02() -> bool:
    """At beta = +pi/2 R does not change if alpha and gamma grow together."""
    one, other = (np.array(ZYX.to_matrix((0.4 + x, math.pi / 2, -0.9 + x))) for x in (0.0, 0.7))
    return bool(np.abs(one - other).max() < TINY)


def check_E03() -> bool:
    """beta = +pi/2 has n = (0, 0, -1), and -pi/2 has (0, 0, +1)."""
    return all(abs(ZYX.to_matrix((0.4, sign * math.pi / 2, -0.9)).n[2] + sign) < TINY for sign in (1, -1))


def check_E04() -> bool:
    """B has elements of at most 1 at both poles."""
    poles = [from_quaternion(ABOUT_Y[degrees]) for degrees in (90, -90)]
    return all(np.abs(matrix_B(ZYX, R)).max() <= 1 + TINY for R in poles)


def check_E05() -> bool:
    """(2.14) under u = -Kp E - Kd Edot has a growing mode; with the permutation undone it has none."""
    gains, P = Gains(), np.eye(3)[::-1]

    def growth(order: np.ndarray) -> float:
        closed = P @ order
        system = np.block([[np.zeros((3, 3)), np.eye(3)], [-gains.kp * closed, -gains.kv * closed]])
        return np.linalg.eigvals(system).real.max()

    return growth(np.eye(3)) > 1.0 and growth(P) < 0.0


def check_E06() -> bool:
    """(dB/dt)^-1 never exists, for a column of B is constant; d(B^-1)/dt does."""
    step = 1e-6
    E = np.array((0.4, 0.6, -0.9))
    shifts = step * np.array(RATES)
    angles = [tuple((E + sign * shifts).tolist()) for sign in (1, -1)]
    B = [matrix_B(ZYX, ZYX.to_matrix(E)) for E in angles]
    return abs(np.linalg.det((B[0] - B[1]) / (2 * step))) < 1e-9  # rounding of the difference is 1e-10


def check_E07() -> bool:
    """Edot = B^-1 omega of (2.9) undoes (2.8)."""
    at = ZYX.chart_of((0.4, 0.6, -0.9))
    return bool(np.allclose(ZYX.rates(at, ZYX.angular_velocity(at, RATES)), RATES, atol=TINY))


ERRATA = tuple(
    Erratum(id, **words, check=globals().get(f"check_{id}"))
    for id, words in read_texts(Path(__file__).with_suffix(".toml")).items()
)

UNTESTABLE: list[dict[str, str]] = read_texts(Path(__file__).with_name("untestable.toml"))["sentences"]
"""Sentences of the paper that no run decides: section, where it stands; quote, its words; why it is not tested here."""

COVERAGE = tuple(
    Item(paper, says, tuple(on.split()), tuple(map(SentenceSubject, subjects.split())))
    for paper, says, on, subjects in read_texts(Path(__file__).with_name("coverage.toml"))["items"]
)
