"""C21: measured moments in Euler coordinates, F_e = diag(I, B)^T F_c, and their work (Murphy 1988, 3.10-3.12)."""

from __future__ import annotations

import functools
import math

import numpy as np

from bench.base.on_first_use import Turn, pd
from bench.experiments.suites import SUITES
from bench.findings.amounts import count_of
from bench.findings.claims.euler_jacobian import COORDINATES, DIFFERENCED, EPS, ROUNDINGS
from bench.findings.claims.side_by_side import PROBE
from bench.findings.claims.tables import WHOLE, Results, evidence, some
from bench.findings.claims.verdict import Evidence, NoEvidence, Word, claim, read_limits, word_of
from bench.findings.theory.compliance_theory import matrix_B
from bench.law.contenders.registry import contenders, representation
from bench.law.kinds import Coordinates
from bench.law.so3 import Rotation, from_quaternion

LIMIT = read_limits(__file__)


LOST = 1e-12
"""Smallest singular value of B at a pole, and the size of what it leaves of the lost moment: rounding of pi/2."""

AT_RANDOM, NEAR_POLE, AT_POLE = "random", "near", "exact"

STEP = 2.0 ** (-52 / 3)
"""rad; of a central difference, whose truncation and rounding then are both about its square."""


@claim("C21")
def c21(results: Results) -> tuple[Word, Evidence]:
    """Judge the balance at random and polar orientations, the loop's work residual, and what poles lose."""
    looped = results.table("compliance", task=PROBE, controller="hybrid", representation=COORDINATES)
    looped = looped[(looped["outcome"] == "done") & looped["work_residual"].notna()]
    looped = some(looped, f"work residual of {PROBE} by hybrid/{COORDINATES}")
    poses, least = looped["pose"].nunique(), SUITES["quick"].in_contact.redundant_poses or 0
    if results.folder and poses < least:
        raise NoEvidence(
            f"hybrid/{COORDINATES} ran {PROBE} at {poses} poses of the {least} that the claim "
            f"needs: {WHOLE}"
        )
    residual = looped["work_residual"] * np.cos(looped["beta"]) / EPS
    found, elsewhere = results.found_by(experiment)
    closes = found["exists"] & (found["gap"] <= ROUNDINGS * EPS) & (found["difference_gap"] <= ROUNDINGS * DIFFERENCED)
    poles = found["place"] == AT_POLE
    off_poles = closes[~poles].all() and (residual <= ROUNDINGS).all()
    word = word_of(off_poles and closes.all() and found["gain"].max() <= LIMIT.USABLE, off_poles)
    usable = found["gain"] <= LIMIT.USABLE
    rank = 2 if found.loc[poles, "least"].max() <= LOST else 3
    return word, evidence(
        f"""We tested {len(found):,} orientations, {int(poles.sum())} of them exact poles. The converted moment F_E is
        finite at {count_of(int(found["exists"].sum()), len(found), "orientations")}. We computed the power of the
        converted moment, F_E^T Edot, and the power of the measured moment, m^T omega. The two powers differ by at most
        {found["gap"].max() / EPS:.1f} eps. If omega comes from numerical differences of R(E), they differ by at most
        {found["difference_gap"].max() / DIFFERENCED:.1f} eps^(2/3). In {len(looped):,} simulated episodes of the task
        'wrench-probe', they differ by at most {residual.max():.1f} eps / cos(beta), relative to |m| |omega|. At the
        poles, B has rank {rank}, and B^T converts one moment of length 1 to a vector of length
        {found.loc[poles, "lost"].max():.0g}. In {len(elsewhere)} other representations, the powers differ by at most
        {max(elsewhere) / EPS:.1f} eps. If a moment of 1 N m is not converted, and the rates have the length 1, the
        median difference of the powers is {found["raw_gap"].median():.2f} W. If alpha is the only compliant angle, the
        controller amplifies a moment by a factor of at most {LIMIT.USABLE:g} at
        {count_of(int(usable.sum()), len(found), "orientations")}. Near the poles, but not exactly on them, this factor
        reaches {found.loc[~poles, "gain"].max():.1e}, as 1 / cos(beta) predicts.""",
        len(found) + len(looped),
        measured=f"""At {len(found):,} orientations, the work of the measured moment and of the converted moment is the
        same: the difference is at most {found["gap"].max() / EPS:.1f} eps (rounding; eps = 2.2e-16). Near the poles,
        the controller amplifies moments by a factor of up to {found.loc[~poles, "gain"].max():.1e}.""",
    )


@functools.cache
def experiment() -> tuple[pd.DataFrame, list[float]]:
    """`balances` of Z-Y-X at random and polar orientations, and the greatest gap of every other representation."""
    zyx = representation(COORDINATES)
    anywhere = [(AT_RANDOM, R) for R in random_orientations(LIMIT.TURNS, LIMIT.SEED)]
    others = [one for one in contenders("representations").values() if one.name != COORDINATES]
    elsewhere = [float(balances(one, anywhere[: LIMIT.TURNS_ELSEWHERE], LIMIT.SEED)["gap"].max()) for one in others]
    return balances(zyx, anywhere + polar_orientations(zyx, LIMIT.SEED), LIMIT.SEED), elsewhere


def random_orientations(count: int, seed: int) -> list[Rotation]:
    """Uniform by the Haar measure: normalized quaternions of four normal numbers."""
    quats = np.random.default_rng(seed).normal(size=(count, 4))
    quats /= np.linalg.norm(quats, axis=1, keepdims=True)
    return [from_quaternion(tuple(quat)) for quat in quats.tolist()]


def polar_orientations(zyx: Coordinates, seed: int) -> list[tuple[str, Rotation]]:
    """About both poles of Z-Y-X: (exact or near, R), at 10^-1 to 10^-12 rad and exactly."""
    rng, found = np.random.default_rng(seed), []
    for side in (1.0, -1.0):
        for alpha, gamma in rng.uniform(-math.pi, math.pi, (LIMIT.BESIDE, 2)).tolist():
            s, c = math.sin(alpha), math.cos(alpha)  # gamma adds to alpha on a pole
            found.append((AT_POLE, Rotation((0.0, 0.0, -side), (-s, c, 0.0), (side * c, side * s, 0.0))))
            near = [side * (math.pi / 2 - 10.0**-k) for k in range(1, LIMIT.DECADES + 1)]
            found += [(NEAR_POLE, zyx.to_matrix((alpha, beta, gamma))) for beta in near]
    return found


def balance(along: Coordinates, R: Rotation, moment: np.ndarray, rates: np.ndarray) -> dict:
    """Both sides of (3.10) at R for a moment and rates of the coordinates, each of length 1.

    Returns:
        exists: whether F_E = B^T m is finite. gap: |F_E . Edot - m . B Edot|. difference_gap: the same with omega from
        R(E), differenced along Edot. raw_gap: the same with the moment not converted (of three coordinates). least:
        smallest singular value of B; lost: |B^T e| of the moment e of length 1 that it belongs to. gain: size of B^-T S
        B^T with S = diag(1, 0, 0), infinite where B has no inverse.
    """
    at = along.chart(R)
    B = matrix_B(along, R)
    F_E = np.array(along.generalized(at, tuple(moment.tolist())))
    raw = [moment[along.about.index(i)] for i in range(3)] if along.about else [math.nan] * len(rates)
    ends = [along.to_matrix(tuple((at.E + side * STEP * rates).tolist())) for side in (1, -1)]
    after, before = (np.array(one).T for one in ends)
    omega = Turn.from_matrix(after @ before.T).as_rotvec() / (2 * STEP)
    moments, sizes, _ = np.linalg.svd(B)
    is_regular = B.shape == (3, 3) and sizes[-1] > ROUNDINGS * EPS
    return {
        "exists": bool(np.isfinite(F_E).all()),
        "gap": abs(F_E @ rates - moment @ along.angular_velocity(at, tuple(rates.tolist()))),
        "difference_gap": abs(F_E @ rates - moment @ omega),
        "raw_gap": abs(raw @ rates - moment @ B @ rates),
        "least": sizes[-1],
        "lost": float(np.linalg.norm(along.generalized(at, tuple(moments[:, -1].tolist())))),
        "gain": float(np.linalg.norm(np.linalg.inv(B)[0]) * np.linalg.norm(B[:, 0])) if is_regular else math.inf,
    }


def balances(along: Coordinates, places: list[tuple[str, Rotation]], seed: int) -> pd.DataFrame:
    """Return a row an orientation: `place` and what `balance` finds for random directions of moment and rates."""
    rng, rows = np.random.default_rng(seed), []
    for place, R in places:
        drawn = rng.normal(size=3), rng.normal(size=len(along.chart(R).E))
        moment, rates = (vector / np.linalg.norm(vector) for vector in drawn)
        rows.append({"place": place, **balance(along, R, moment, rates)})
    return pd.DataFrame(rows)
