"""C04 and C05: where the rotation-matrix law's error is zero away from the goal (Murphy 1988, 2.12 and 2.4)."""

import numpy as np

from bench.findings.claims import probes
from bench.findings.claims.rotation_matrix import LAW
from bench.findings.claims.tables import MAIN_ENGINE, evidence, on_every_engine, settled, some
from bench.findings.claims.verdict import Earlier, Word, claim, word_of
from bench.law.contender import Gains
from bench.law.so3 import IDENTITY, cross, from_quaternion
from tasks.sphere import axes

ZERO_ERROR = 2.0**-52
"""One rounding of an element of R."""

AWAY_RAD = 1e-3
NEAR_ZERO = 1e-9


@claim(
    id="C04",
    section="2.4",
    equation="(2.12)",
    quote="""
        These orientations exist due to the use of the cross product in calculating the position error:
        anti-parallel vectors also have a zero cross product. An example is a 180° rotation about any axis.
    """,
    value="180°",
    correction="""
        Columns are anti-parallel at 180° rotations about x, y and z only; about other axes the three cross products
        cancel in their sum.
    """,
    written="2026-11-23 953f62a",
    sentence="""
        Example: a rotation of 180 degrees about any axis, because anti-parallel vectors have no cross
        product.
    """,
    question="""
        Is the error zero at exact half turns about every axis, does the body stay there, and for that
        reason?
    """,
    criterion=f"""
        At every exact half turn of the set half-turn: |e| of (2.12) at most {ZERO_ERROR:.1e} (one
        rounding). It holds if so, and if each of the three cross products of (2.12) vanishes by itself
        there (columns parallel or anti-parallel); with a correction if the error vanishes at all of them but
        the three cross products cancel only in their sum; if the error is larger at any of them, it does
        not hold. How many of the episodes leave is reported.
    """,
    open="""
        Whether a start stays is a matter of rounding, so of the engine and its step: each engine is
        reported. Gains and horizon decide how long an escape takes, not whether the error is zero.
    """,
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            "An episode that leaves made a correction too; but that is rounding, and so our clock's.",
            Word.CORRECTED,
        ),
    ),
)
@on_every_engine
def c04(results, engine):
    """The error and its three cross products at exact half turns, and how the episodes end."""
    turns = results.episodes(LAW, engine, "half-turn")
    exact = some(turns[probes.boundary_distance(turns)["half_turn"] <= probes.EXACT_RAD], "exact half turn")
    orientations = probes.rotations(exact)
    errors = [float(np.linalg.norm(error(R))) for R in orientations]
    products = [_largest_product(R) for R in orientations]
    parallel = sum(product <= ZERO_ERROR for product in products)
    leave = int(settled(exact).sum())
    is_zero = max(errors) <= ZERO_ERROR
    word = word_of(is_zero and parallel == len(exact), is_zero)
    return word, evidence(
        f"""At {len(exact)} exact half turns the error is at most {max(errors):.1g}, and {leave} of them settle. Each
        cross product is zero by itself at {parallel} (axes x, y, z); at the other {len(exact) - parallel} they cancel
        in the sum only, the largest being {max(products):.2f}.""",
        len(exact),
        ("episodes", "experiment"),
    )


@claim(
    id="C05",
    section="2.4",
    equation="(2.12)",
    quote="""
        It was also possible for the cross product elements to cancel in a series of points about the 180°
        rotation.
    """,
    written="2026-11-23 953f62a",
    sentence="""
        The elements of the cross product may also cancel in a series of points about the 180 degree
        rotation.
    """,
    question="Does the error vanish off the 180° rotations, or do elements cancel on them?",
    criterion=f"""
        The sentence is ambiguous, and both readings are judged. (a) Off the 180° rotation: |e| of (2.12) against
        sin(angle), the angle by the judge, at every start of the run's tables with angle and pi - angle above
        {AWAY_RAD:g} rad, and by a search (downhill simplex on |e| / sin(angle) over rotation vectors, from 16
        directions): some |e| is below {NEAR_ZERO:g}. (b) On it: at exact 180° rotations of the set half-turn the sum of
        the three cross products vanishes (to one rounding) while one of them does not. It holds if both readings are
        true, with a correction if one is, and does not hold if neither is.
    """,
    open="Nothing: the error is a function of the orientation alone.",
    readings=(
        "(a) zeros near, but not at, the 180° rotation",
        "(b) 180° rotations about axes other than x, y, z, where no cross product is zero but their sum is",
    ),
    correction="The points are 180° rotations themselves, about axes other than x, y, z: none lies off 180 degrees.",
    earlier=(Earlier("2026-11-21 9072535", "Only reading (a) was judged; the sentence has another one.", Word.FAILS),),
)
def c05(results):
    """|e| over sin(angle), at every start of the run and as low as a search gets; what cancels at 180° rotations."""
    from scipy.optimize import minimize

    frame = results.episodes(LAW, MAIN_ENGINE).drop_duplicates(["start_set", "start_id"])
    frame = some(frame[frame["angle0_rad"].between(AWAY_RAD, np.pi - AWAY_RAD)], "start away from zero and half turn")
    pairs = zip(probes.rotations(frame), probes.rotations(frame, probes.GOAL_QUAT), strict=True)
    ratios = np.array([np.linalg.norm(error(R, R_d)) for R, R_d in pairs]) / np.sin(frame["angle0_rad"])
    found = [minimize(_ratio, 1.5 * axis, method="Nelder-Mead", options={"maxiter": 200}) for axis in axes(16)]
    states = sum(one.nfev for one in found)
    lowest = min(float(ratios.min()), *(one.fun for one in found))
    least = min(float((ratios * np.sin(frame["angle0_rad"])).min()), *(_length(one.x) for one in found))
    turns = results.episodes(LAW, MAIN_ENGINE, "half-turn")
    exact = some(turns[probes.boundary_distance(turns)["half_turn"] <= probes.EXACT_RAD], "exact 180° rotation")
    cancel = sum(float(np.linalg.norm(error(R))) <= ZERO_ERROR < _largest_product(R) for R in probes.rotations(exact))
    readings = (least < NEAR_ZERO, cancel > 0)
    return word_of(all(readings), any(readings)), evidence(
        f"""Ambiguous. (a) Off the 180° rotation |e| / sin(angle) is never below {lowest:.9f} at {len(frame):,} starts
        and {states:,} states of a search, and |e| never below {least:.1e}. (b) At {cancel} of {len(exact)} exact 180°
        rotations the cross products are not zero and their sum is.""",
        len(frame) + states + len(exact),
        ("episodes", "experiment"),
    )


def _largest_product(R) -> float:
    """The largest of the three cross products of (2.12), goal zero."""
    return float(max(np.linalg.norm(cross(c, d)) for c, d in zip(R, IDENTITY, strict=True)))


def error(R, R_d=IDENTITY) -> np.ndarray:
    """e of (2.12): the law's command at rest over Kp."""
    return probes.command(LAW, R, R_d=R_d) / Gains().kp


def _ratio(vector) -> float:
    angle = float(np.linalg.norm(vector))
    if not AWAY_RAD < angle < np.pi - AWAY_RAD:
        return 2.0  # out of bounds: more than any ratio
    return _length(vector) / np.sin(angle)


def _length(vector) -> float:
    """|e| at a rotation vector."""
    return float(np.linalg.norm(error(from_quaternion(probes.about(vector, float(np.linalg.norm(vector)))))))
