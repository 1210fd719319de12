"""What is printed wrongly in Murphy 1988, what is right, and how that was checked.

Where a check can be computed it is a function that returns True if the erratum is confirmed; the others are by
reading. Spellings are those of our transcription of the scan.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.contenders.registry import representation
from bench.findings.claims import probes
from bench.law.contender import Gains
from bench.law.so3 import from_quaternion

HALF = math.sqrt(0.5)
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


def _to_matrix(E):
    return representation("zyx-euler").to_matrix(E)


def half_turn_is_regular() -> bool:
    """B is regular at 180 degrees about Y and singular at 90."""
    half, quarter = (0.0, 0.0, 1.0, 0.0), (HALF, 0.0, HALF, 0.0)
    least = [np.linalg.svd(probes.euler_B(from_quaternion(q)), compute_uv=False)[-1] for q in (half, quarter)]
    return least[0] > 0.5 and least[1] < TINY


def difference_at_plus() -> bool:
    """At beta = +pi/2 R does not change if alpha and gamma grow together."""
    one, other = (np.array(_to_matrix((0.4 + x, math.pi / 2, -0.9 + x))) for x in (0.0, 0.7))
    return bool(np.abs(one - other).max() < TINY)


def normal_has_other_sign() -> bool:
    """beta = +pi/2 has n = (0, 0, -1), and -pi/2 has (0, 0, +1)."""
    return all(abs(_to_matrix((0.4, sign * math.pi / 2, -0.9)).n[2] + sign) < TINY for sign in (1, -1))


def pole_B_is_finite() -> bool:
    """B has elements of at most 1 at both poles."""
    poles = [from_quaternion((HALF, 0.0, sign * HALF, 0.0)) for sign in (1, -1)]
    return all(np.abs(probes.euler_B(R)).max() <= 1 + TINY for R in poles)


def printed_feedback_is_unstable() -> bool:
    """(2.14) under u = -Kp E - Kd Edot has a growing mode; with the permutation undone it has none."""
    gains, P = Gains(), np.eye(3)[::-1]

    def growth(order):
        closed = P @ order
        system = np.block([[np.zeros((3, 3)), np.eye(3)], [-gains.kp * closed, -gains.kv * closed]])
        return np.linalg.eigvals(system).real.max()

    return growth(np.eye(3)) > 1.0 and growth(P) < 0.0


def B_rate_has_no_inverse() -> bool:
    """(dB/dt)^-1 never exists, for a column of B is constant; d(B^-1)/dt does."""
    step = 1e-6
    E = np.array((0.4, 0.6, -0.9))
    B = [probes.euler_B(_to_matrix(tuple((E + sign * step * np.array(RATES)).tolist()))) for sign in (1, -1)]
    return abs(np.linalg.det((B[0] - B[1]) / (2 * step))) < 1e-9  # rounding of the difference is 1e-10


def rates_need_the_inverse() -> bool:
    """Edot = B^-1 omega of (2.9) undoes (2.8)."""
    zyx = representation("zyx-euler")
    at = zyx.chart_of((0.4, 0.6, -0.9))
    return bool(np.allclose(zyx.rates(at, zyx.angular_velocity(at, RATES)), RATES, atol=TINY))


ERRATA = (
    Erratum(
        "E01",
        "2.2, degenerate rotation of Z-Y-X angles",
        "180° rotation about the Y, or Pitch axis",
        "90°, beta = +-pi/2, as 2.3 and (2.9) have it (C14)",
        "smallest singular value of B at both rotations",
        half_turn_is_regular,
    ),
    Erratum(
        "E02",
        "2.2, below 'Dynamics using Euler Angles'",
        "only the sum of alpha and gamma",
        "at beta = +pi/2 only their difference, at -pi/2 only their sum (C15)",
        "R with alpha and gamma moved together",
        difference_at_plus,
    ),
    Erratum(
        "E03",
        "2.2, same paragraph",
        "beta = +-pi/2 whenever n = [0 0 +-1]^T",
        "n = [0 0 -+1]^T, for n_z = -sin(beta)",
        "the first column of R at both poles",
        normal_has_other_sign,
    ),
    Erratum(
        "E04",
        "2.2 below (2.11); 2.4, third regulator",
        "The matrix B does not exist; divide by zero in elements of the B matrix",
        "B^-1 does not exist; B always does, as 3.3 says (C16, C10)",
        "elements of B at both poles",
        pole_B_is_finite,
    ),
    Erratum(
        "E05",
        "2.3 below (2.14)",
        "u = -Kp E - Kd Edot",
        "u = P(-Kp E - Kd Edot), P the permutation of (2.14): u_x from gamma, u_z from alpha",
        "eigenvalues of the closed loop of (2.14), and the law linearized-euler-literal",
        printed_feedback_is_unstable,
    ),
    Erratum(
        "E06",
        "(2.10), (2.11), (2.15)",
        "B^-1 with a dot over B alone",
        "d(B^-1)/dt; the inverse of dB/dt exists nowhere",
        "determinant of dB/dt",
        B_rate_has_no_inverse,
    ),
    Erratum(
        "E07",
        "2.2, last paragraph",
        "Euler angle velocity ... from Equation 2.8",
        "(2.9): (2.8) gives omega from it",
        "(2.9) undoes (2.8)",
        rates_need_the_inverse,
    ),
    Erratum(
        "E08",
        "(2.13) against 2.3 and 2.4",
        "K_v for the rotation-matrix law, K_d for the others",
        "one velocity gain under two names; the first law's values are given nowhere",
        "by reading",
    ),
    Erratum(
        "E09",
        "3.2, first sentence",
        "the Cartesian controller from section 2.2",
        "section 2.1, or equation (2.2), where it is",
        "by reading",
    ),
    Erratum(
        "E10",
        "3.1, below (3.3)",
        "J_E has the property of being zero at points in the workspace",
        "of being singular: its determinant is zero, not the matrix (C18)",
        "by reading",
    ),
    Erratum(
        "E11",
        "2.1 and 3.1 against 2.2 and the references",
        "Paul, 1980",
        "Paul 1981: the list has no other",
        "by reading",
    ),
    Erratum(
        "E12",
        "1, Euler Jacobian in the literature",
        "Khatib, 1985,1986",
        "for 1986 Khatib and Burdick 1986: the list has no other",
        "by reading",
    ),
    Erratum("E13", "References, Åström 1982", "A Simmon Tutorial", "A Simnon Tutorial, as 2.4 spells it", "by reading"),
    Erratum(
        "E14",
        "References, Raibert and Craig 1981",
        "Vol. 102",
        "Vol. 103, the journal's volume of 1981",
        "by the journal's own record (DOI 10.1115/1.3139652)",
    ),
    Erratum(
        "E15",
        "References",
        "Mason 1981; Tarn, Bejczy and Yun 1986a",
        "listed, and cited nowhere in the text",
        "by reading",
    ),
    Erratum("E16", "4, third paragraph", "The results compliment those", "complement", "by reading"),
    Erratum(
        "E17",
        "2.1 and chapter 3",
        "xdot_c = J qdot, then xdot_e = [xdot ... omega_z], and x_e is not defined",
        "x_c: chapter 3 gives the name x_e to the pose with Euler angles, and (3.9) has both",
        "by reading; perhaps a slip of the transcription",
    ),
    Erratum(
        "E18",
        "References, Mason 1981",
        "Compliance and Control for Computer Controlled Manipulators",
        "Compliance and Force Control for Computer Controlled Manipulators",
        "by the author's own list of publications",
    ),
    Erratum("E19", "References, Tarn 1986b", "of Two Arms", "probably: of Two Robot Arms", "not verified"),
    Erratum(
        "E20",
        "2.2, and below (2.11)",
        "Z-Y-Z angles degenerate at zero rotation",
        "at beta = 0 and at beta = pi",
        "by reading: a column of their B vanishes against another where sin(beta) = 0",
    ),
    Erratum(
        "E21",
        "2.2, below (2.5)",
        "any such elimination would require dividing by one of the elements",
        "it takes square roots too, and a sign is lost",
        "by reading (2.5): two constraints are quadratic",
    ),
    Erratum(
        "E22",
        "2.4 against 2.5, linearized law",
        "satisfactory only in a linear region around zero rotation",
        "2.4 says that it is stable for much larger initial values (C06)",
        "by reading",
    ),
    Erratum(
        "E23",
        "2.2; 3.1",
        "infinite sets of Euler angles of the angle-axis; 6 x 1 vector representing Cartesian position",
        "sets of angle and axis; a pose, position and orientation",
        "by reading",
    ),
    Erratum(
        "E24",
        "2.3, below (2.16)",
        "PD, similar to the previous two ... u_e = Kp(E_d - E) - Kd Edot",
        "the second law has no E_d: it regulates to zero only (E05)",
        "by reading",
    ),
)
