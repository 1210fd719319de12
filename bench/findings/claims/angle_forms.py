"""C34: whether results depend on the form of Euler angles (Murphy 1988, 3.3)."""

from __future__ import annotations

import itertools

import numpy as np

from bench.contenders.registry import representation
from bench.findings.claims.euler_jacobian import SLOPE, SLOPE_TIGHT
from bench.findings.claims.feedback_linearized import LAW
from bench.findings.claims.representations import condition_in
from bench.findings.claims.tables import MAIN_ENGINE, Share, evidence, settled, share, some
from bench.findings.claims.verdict import Earlier, Word, claim, word_of
from bench.tables.read import FREE_BODY
from bench.tables.statistics import Estimate, quantile_estimate

REGULAR, AT_ZERO = ("zyx-euler", "xyz-euler"), "zyz-euler"
"""Forms whose degenerate orientations are a quarter turn from zero, and one that is degenerate at zero."""

SHARES, TIMES = 0.05, 0.05
"""Points of a share, and relative difference of a median time, up to which results are the same 'for the most part'."""

DECADES, PAIRS = 6, 12
SETS = ("uniform", "half-turn")
"""Starts that no form of angles was asked for."""


@claim(
    id="C34",
    section="3.3",
    quote="""
        For the most part, the results remain independent of the form of Euler angles, with the exception of the problem
        of compliance.
    """,
    correction="They are the same of forms that are regular at the goal; Z-Y-Z, degenerate at zero, gives others.",
    written="2026-11-23 a2b9306",
    earlier=(
        Earlier(
            "2026-11-23 bc126c2",
            "Each form's poles were sought among poses of arms, which are at Z-Y-X's alone: mended after that result.",
            Word.FAILS,
        ),
    ),
    sentence="Results do not depend on the form of Euler angles, compliance excepted.",
    question="Do Z-Y-X, X-Y-Z and Z-Y-Z settle alike, and do their Jacobians degenerate alike?",
    criterion=f"""
        Feedback linearization in each form, the same starts of {" and ".join(SETS)}, goal zero. Two forms are alike if
        in each set the shares that settle differ by at most {SHARES:.0%} and the median settling times by at most
        {TIMES:.0%} (or their 95 % intervals meet), and if the condition number of B of each, which is what J_E adds to
        J, rises towards its own pole by {SLOPE:g} +- {SLOPE_TIGHT:.0%} decades a decade, as in C18: 10^-k rad from
        it, k = 1 to {DECADES}, {PAIRS} pairs of the other angles. It holds if all
        three are alike; with a correction if {" and ".join(REGULAR)} are, and {AT_ZERO} is not; otherwise it does not
        hold. Reported: how many starts of each set every form loses.
    """,
    open="""
        Which results are meant is not said: those of chapters 2 and 3 on regulators and on the Jacobian are asked. That
        Z-Y-Z is degenerate at zero is what 2.2 sets it aside for.
    """,
)
def c34(results):
    """Pairs of forms by how their laws settle, and each form's Jacobian at its pole."""
    forms, rows = (*REGULAR, AT_ZERO), {}
    episodes = results.table("episodes", **FREE_BODY, task="free-body", regulator=LAW, engine=MAIN_ENGINE)
    for form in forms:
        own = episodes[episodes["representation"] == form]
        sets = {name: own[own["start_set"] == name] for name in SETS}
        rows[form] = {name: some(one, f"episode of {LAW}/{form} from {name}") for name, one in sets.items()}
    for name in SETS:
        common = set.intersection(*(set(rows[form][name]["start_id"]) for form in forms))
        for form in forms:
            rows[form][name] = rows[form][name][rows[form][name]["start_id"].isin(common)]
    found = {form: {name: _settles(rows[form][name]) for name in SETS} for form in forms}
    degenerate = {form: _degenerates(form) for form in forms}
    alike = {
        (one, two): degenerate[one][0]
        and degenerate[two][0]
        and all(_alike(found[one][name], found[two][name]) for name in SETS)
        for one, two in itertools.combinations(forms, 2)
    }
    word = word_of(all(alike.values()), alike[REGULAR] and not all(alike.values()))
    told = "; ".join(f"{form} {_told(found[form])}, {degenerate[form][1]}" for form in forms)
    return word, evidence(
        f"""{told}. Alike: {", ".join(" and ".join(pair) for pair, facts in alike.items() if facts) or "none"}.""",
        sum(len(one) for own in rows.values() for one in own.values()) + len(forms) * PAIRS * DECADES,
        ("episodes", "experiment"),
    )


def _settles(rows) -> tuple[Share, Estimate]:
    times = rows["settling_time_s"].where(settled(rows), np.inf).to_numpy(float)
    return share(settled(rows)), quantile_estimate(times, 0.5)


def _alike(one: tuple[Share, Estimate], two: tuple[Share, Estimate]) -> bool:
    """Whether shares and medians are the same for the most part."""
    (kept, time), (other_kept, other_time) = one, two
    meet = time.low <= other_time.high and other_time.low <= time.high
    same = meet or abs(time.value / other_time.value - 1) <= TIMES
    return abs(kept.value - other_kept.value) <= SHARES and same


def _degenerates(form: str) -> tuple[bool, str]:
    """Whether a form's B has C18's slope at its pole, and what it is."""
    along, at_pole = representation(form), 0.0 if form == AT_ZERO else np.pi / 2
    outer = np.random.default_rng(0).uniform(-3.0, 3.0, (PAIRS, 2)).tolist()
    logs = [
        [np.log10(condition_in(form, along.to_matrix((one, at_pole + 10.0**-k, two)))) for k in range(1, DECADES + 1)]
        for one, two in outer
    ]
    slopes = np.diff(logs, axis=1)
    tight = np.abs(slopes - SLOPE).max() <= SLOPE_TIGHT * SLOPE
    return bool(tight), f"B {slopes.min():.3f} to {slopes.max():.3f} decades a decade"


def _told(found: dict[str, tuple[Share, Estimate]]) -> str:
    return ", ".join(
        f"{name} {kept.n - kept.k} of {kept.n} lost, {time.value:.3f} s" for name, (kept, time) in found.items()
    )
