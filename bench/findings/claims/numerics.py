"""C32: what arithmetic does to the rotation-matrix law (Murphy 1988, 2.12 and 2.5)."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from bench.findings.claims import probes
from bench.findings.claims.adequacy import CALLS
from bench.findings.claims.half_turns import error
from bench.findings.claims.rotation_matrix import LAW
from bench.findings.claims.tables import evidence, some
from bench.findings.claims.verdict import claim, word_of
from bench.law.so3 import Rotation

EPS = 2.0**-52
ROUNDINGS = 10.0
"""Each element of e sums six products of numbers up to 1: eleven roundings of half an eps, of partial sums up to 3."""

CLOSEST_RAD, DIGITS = 1e-12, 1e-2
"""To the goal and to a 180° rotation; and what rounding may make of the error's length there."""

BROKEN = ("diverged", "singular", "saturated", "crashed")


@claim(
    id="C32",
    section="2.5",
    equation="(2.12)",
    quote="The regulator was remarkably simple to calculate with no numeric difficulties.",
    correction="Close to a 180° rotation rounding takes the digits of its error.",
    written="2026-11-23 bc126c2",
    sentence="The rotation-matrix law has no numeric difficulties.",
    question="Is its error as exact as the numbers it is given, everywhere, and its command finite?",
    criterion=f"""
        e of (2.12) as the law computes it, against the same in exact fractions, at every start of the run's tables: (a)
        it is finite and off by at most {ROUNDINGS:g} eps; (b) it divides by nothing and calls no function
        (costs.parquet, both branches); (c) no episode of it, by any engine, ends {", ".join(BROKEN)}; (d) at every
        start farther than {CLOSEST_RAD:g} rad from the goal and from a 180° rotation it is off by at most {DIGITS:.0%}
        of its own length. It holds if all four pass; with a correction if (a) to (c) do; otherwise it does not hold.
    """,
    open="""
        That the error is zero at a 180° rotation is no matter of arithmetic; the paper says it before ('points at which
        the orientation error would be erroneously zero').
    """,
)
def c32(results):
    """Rounding of e against exact fractions, what the law is made of, and how its episodes end."""
    every = results.free_body("episodes", task="free-body", regulator=LAW)
    ended = some(every[every["outcome"].isin(BROKEN)], "") if every["outcome"].isin(BROKEN).any() else []
    frame = some(every, f"episode of {LAW}").drop_duplicates(["start_set", "start_id"])
    pairs = list(zip(probes.rotations(frame), probes.rotations(frame, probes.GOAL_QUAT), strict=True))
    ours = np.array([error(R, R_d) for R, R_d in pairs])
    exact = [_exact(R, R_d) for R, R_d in pairs]
    off = np.array([_off(*both) for both in zip(ours, exact, strict=True)])
    angle = frame["angle0_rad"].to_numpy()
    inner = np.minimum(angle, np.pi - angle) >= CLOSEST_RAD * (1 - DIGITS)
    relative = (off / np.linalg.norm(ours, axis=1).clip(min=EPS))[inner]
    costs = some(results.free_body("costs", regulator=LAW), f"cost of {LAW}")
    asked = int(costs[["div", *CALLS]].to_numpy().sum())
    sound = bool(np.isfinite(ours).all() and off.max() <= ROUNDINGS * EPS and not asked and not len(ended))
    word = word_of(sound and relative.max() <= DIGITS, sound)
    return word, evidence(
        f"""At {len(frame):,} starts e is off by at most {off.max() / EPS:.1f} eps, and by {relative.max():.1e} of its
        length, closest to a 180° rotation. It takes {asked} divisions and calls; {len(ended)} of {len(every):,}
        episodes end {" or ".join(BROKEN)}.""",
        len(every) + len(costs),
        ("episodes", "costs", "experiment"),
    )


def _off(ours: np.ndarray, exact: list[Fraction]) -> float:
    return float(max(abs(Fraction(x) - y) for x, y in zip(ours, exact, strict=True)))


def _exact(R: Rotation, R_d: Rotation) -> list[Fraction]:
    """e of (2.12) of the same doubles, without rounding."""
    columns = [([Fraction(x) for x in c], [Fraction(x) for x in d]) for c, d in zip(R, R_d, strict=True)]
    return [sum((c[i - 2] * d[i - 1] - c[i - 1] * d[i - 2] for c, d in columns), Fraction(0)) / 2 for i in range(3)]
