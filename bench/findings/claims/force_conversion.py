"""C21: measured moments in Euler coordinates, F_e = diag(I, B)^T F_c, and their work (Murphy 1988, 3.10-3.12)."""

from __future__ import annotations

import numpy as np

from bench.base.errors import NoEvidence
from bench.experiments.probe_values import coordinates
from bench.experiments.suites import SUITES
from bench.experiments.tables.run import WHOLE, Run, require_rows
from bench.findings.amounts import count_of
from bench.findings.claims.euler_jacobian import COORDINATES, DIFFERENCED, EPS, ROUNDINGS
from bench.findings.claims.side_by_side import PROBE
from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import Evidence, Word, claim, word_of

TURNS, BESIDE, DECADES = coordinates.TURNS, coordinates.BESIDE, coordinates.POLE_DECADES
TURNS_ELSEWHERE = coordinates.TURNS_ELSEWHERE
# Greatest amplification of a moment with which a controller is of use: it is reached at cos(beta) = 0.1.
USABLE = 10.0

LOST = 1e-12
"""Smallest singular value of B at a pole, and the size of what it leaves of the lost moment: rounding of pi/2."""


@claim("C21")
def c21(run: Run) -> tuple[Word, Evidence]:
    """Judge the balance at random and polar orientations, the loop's work residual, and what poles lose."""
    looped = run.table("compliance", task=PROBE, controller="hybrid", representation=COORDINATES)
    looped = looped[(looped["outcome"] == "done") & looped["work_residual"].notna()]
    looped = require_rows(looped, f"work residual of {PROBE} by hybrid/{COORDINATES}")
    poses, least = looped["pose"].nunique(), SUITES["quick"].sections["contact"]["redundant_poses"]
    if run.has_folder and poses < least:
        raise NoEvidence(
            f"hybrid/{COORDINATES} ran {PROBE} at {poses} poses of the {least} that the claim "
            f"needs: {WHOLE}"
        )
    residual = looped["work_residual"] * np.cos(looped["beta"]) / EPS
    every = run.probe("work")
    found = every[every["representation"] == COORDINATES]
    others = every[every["representation"] != COORDINATES]
    elsewhere = others.groupby("representation", observed=True)["power_gap"].max()
    exists, gap = found["exists"] == 1.0, found["power_gap"]
    closes = exists & (gap <= ROUNDINGS * EPS) & (found["difference_gap"] <= ROUNDINGS * DIFFERENCED)
    poles = found["case"].astype(str).str.startswith(coordinates.AT_POLE)
    off_poles = closes[~poles].all() and (residual <= ROUNDINGS).all()
    word = word_of(off_poles and closes.all() and found["gain"].max() <= USABLE, off_poles)
    usable = found["gain"] <= USABLE
    rank = 2 if found.loc[poles, "least_of_B"].max() <= LOST else 3
    return word, evidence(
        f"""We tested {len(found):,} orientations, {int(poles.sum())} of them exact poles. The converted moment F_E is
        finite at {count_of(int(exists.sum()), len(found), "orientations")}. We computed the power of the
        converted moment, F_E^T Edot, and the power of the measured moment, m^T omega. The two powers differ by at most
        {gap.max() / EPS:.1f} eps. If omega comes from numerical differences of R(E), they differ by at most
        {found["difference_gap"].max() / DIFFERENCED:.1f} eps^(2/3). In {len(looped):,} simulated episodes of the task
        'wrench-probe', they differ by at most {residual.max():.1f} eps / cos(beta), relative to |m| |omega|. At the
        poles, B has rank {rank}, and B^T converts one moment of length 1 to a vector of length
        {found.loc[poles, "lost"].max():.0g}. In {len(elsewhere)} other representations, the powers differ by at most
        {elsewhere.max() / EPS:.1f} eps. If a moment of 1 N m is not converted, and the rates have the length 1, the
        median difference of the powers is {found["unconverted"].median():.2f} W. If alpha is the only compliant angle,
        the controller amplifies a moment by a factor of at most {USABLE:g} at
        {count_of(int(usable.sum()), len(found), "orientations")}. Near the poles, but not exactly on them, this factor
        reaches {found.loc[~poles, "gain"].max():.1e}, as 1 / cos(beta) predicts.""",
        len(found) + len(looped),
        measured=f"""At {len(found):,} orientations, the work of the measured moment and of the converted moment is the
        same: the difference is at most {gap.max() / EPS:.1f} eps (rounding; eps = 2.2e-16). Near the poles,
        the controller amplifies moments by a factor of up to {found.loc[~poles, "gain"].max():.1e}.""",
    )
