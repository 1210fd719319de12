"""C14 to C16: where Z-Y-X angles break down, and what does at that place (Murphy 1988, 2.2, 2.3 and 3.3)."""

import math

import numpy as np

from bench.contenders.registry import representation
from bench.findings.claims import probes
from bench.findings.claims.tables import MAIN_ENGINE, evidence, settled, some
from bench.findings.claims.verdict import MISPRINTS, Earlier, Word, claim, word_of
from bench.law.so3 import from_quaternion

SHIFT = 0.7
"""rad: any amount that no symmetry of the angles shares."""

ON_POLE, SAME = 1e-12, 1e-12


def _least(R) -> float:
    return float(np.linalg.svd(probes.euler_B(R), compute_uv=False)[-1])


@claim(
    id="C14",
    section="2.2 against 2.3",
    quote="With Z-Y-X Euler angles and Roll-Pitch-Yaw angles this occurs at 180° rotation about the Y, or Pitch axis.",
    value="180°",
    correction="It is at 90°, as 2.3 and equation (2.9) of the paper itself have it.",
    written="2026-11-24 fb18d38",
    sentence="With Z-Y-X angles the degeneracy is at a rotation of 180 degrees about Y.",
    question="Is the degenerate rotation about Y one of 180 degrees, or of 90 as the equations have it?",
    criterion=f"""
        Smallest singular value of B (2.8) at rotations of 180, 90 and -90 degrees about Y. It holds if it
        is below {ON_POLE:g} at 180 degrees; with a correction if it is below that at both +-90 degrees, where the
        paper's own equations put it; otherwise it does not hold. {MISPRINTS} The exact 180° rotation about y
        of the set half-turn and the exact poles say the same from simulation: whether the
        feedback-linearized law settles from them is reported.
    """,
    open="Nothing.",
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            """
            A wrong number for the angle made "does not hold", although the paper's own equations correct it: one kind
            of slip got two words.
            """,
            Word.FAILS,
        ),
    ),
)
def c14(results):
    """B at half and quarter turns about Y, and what a simulation from there does."""
    quats = {180: (0.0, 0.0, 1.0, 0.0), 90: (1.0, 0.0, 1.0, 0.0), -90: (1.0, 0.0, -1.0, 0.0)}
    half = math.sqrt(0.5)
    least = {
        degrees: _least(from_quaternion(tuple(x if degrees == 180 else half * x for x in quat)))
        for degrees, quat in quats.items()
    }
    turns = results.free_body("episodes", task="free-body", regulator="feedback-linearized", engine=MAIN_ENGINE)
    about_y = some(turns[turns["start_id"] == "half-turn-y-exact"], "exact 180° rotation about y")
    poles = turns[turns["start_set"] == "poles"]
    poles = some(poles[probes.boundary_distance(poles)["pole"] <= probes.EXACT_RAD], "exact pole")
    word = word_of(least[180] < ON_POLE, max(least[90], least[-90]) < ON_POLE)
    so = "2.3 and the equations are right, 2.2 is not" if word == Word.CORRECTED else "The equations do not correct 2.2"
    return word, evidence(
        f"""Smallest singular value of B: {least[180]:.3f} at 180 degrees about Y, {least[90]:.0e} and {least[-90]:.0e}
        at +-90. The feedback-linearized law settles from {int(settled(about_y).sum())} of {len(about_y)} exact half
        turns about y and from {int(settled(poles).sum())} of {len(poles)} exact poles. {so}.""",
        len(least) + len(about_y) + len(poles),
        ("experiment", "episodes"),
    )


def _change(to_matrix, E, other) -> float:
    return float(np.abs(np.subtract(to_matrix(E), to_matrix(other))).max())


@claim(
    id="C15",
    section="2.2",
    equation="(2.8)",
    quote="""
        It is important to note that when beta = +-pi/2 only the sum of alpha and gamma may be determined from
        the rotation matrix.
    """,
    correction="At beta = +pi/2 it is the difference, at -pi/2 the sum.",
    written="2026-11-21 9072535",
    sentence="At beta = +-pi/2 only the sum of alpha and gamma is determined.",
    question="Is it the sum at both poles?",
    criterion=f"""
        At each pole, over 64 pairs (alpha, gamma): R is the same (to {SAME:g}) if alpha grows and gamma
        falls by one amount (the sum kept), and differs if both grow. It holds if so at both poles; with a
        correction if at exactly one (the difference at the other); otherwise it does not hold. {MISPRINTS}
    """,
    open="Nothing; it follows from the convention of (2.8).",
)
def c15(results):
    """R at both poles as alpha and gamma move against and with each other."""
    to_matrix = representation("zyx-euler").to_matrix
    grid = np.linspace(-3.0, 3.0, 8).tolist()
    moved = {}
    for sign in (1, -1):
        for word, direction in (("sum", -1), ("difference", 1)):
            moved[sign, word] = max(
                _change(to_matrix, (a, sign * math.pi / 2, g), (a + SHIFT, sign * math.pi / 2, g + direction * SHIFT))
                for a in grid
                for g in grid
            )
    by_sum = [moved[sign, "sum"] <= SAME < moved[sign, "difference"] for sign in (1, -1)]
    sums = [pole for pole, is_sum in zip(("+90", "-90"), by_sum, strict=True) if is_sum]
    word = {2: Word.HOLDS, 1: Word.CORRECTED, 0: Word.FAILS}[sum(by_sum)]
    so = f"Only the sum is determined at {' and '.join(sums) or 'neither pole'}"
    return word, evidence(
        f"""With the sum kept R changes by {moved[1, "sum"]:.1g} at +90 and {moved[-1, "sum"]:.0e} at -90 degrees, with
        the difference kept by {moved[1, "difference"]:.0e} and {moved[-1, "difference"]:.1g}. {so}.""",
        4 * len(grid) ** 2,
        ("experiment",),
    )


@claim(
    id="C16",
    section="2.2 against 3.3",
    equation="(2.8), (2.9)",
    quote="The matrix B does not exist whenever beta = +-pi/2 and no model is available at that point.",
    written="2026-11-24 fb18d38",
    sentence="B does not exist at beta = +-pi/2 (2.2); B always exists (3.3).",
    question="Which of the two sentences do B and its inverse support?",
    criterion=f"""
        B (2.8) over the run's orientations and the exact poles. The sentence of 2.2 holds if an element
        of B is not finite at a pole; with a correction if B is finite at every orientation and singular at the poles
        (smallest singular value below {ON_POLE:g}): B^-1 is then what does not exist, as (2.9) shows, and 3.3 is right;
        otherwise it does not hold. {MISPRINTS}
    """,
    open="Nothing.",
    correction="B exists everywhere, as 3.3 says; its inverse does not exist there.",
    earlier=(
        Earlier(
            "2026-11-21 9072535",
            """
            A correction where B is finite and of rank 2 at the poles; but a sentence that says of B what is true of
            B^-1 is as false as that of C14.
            """,
            Word.CORRECTED,
        ),
        Earlier(
            "2026-11-23 953f62a",
            """
            It did not hold if B is finite everywhere; but the same slip, B for its inverse, made a correction in C10.
            """,
            Word.FAILS,
        ),
    ),
)
def c16(results):
    """B at the run's orientations and at both poles."""
    frame = results.episodes("feedback-linearized", MAIN_ENGINE).drop_duplicates(["start_set", "start_id"])
    is_pole = (probes.boundary_distance(frame)["pole"] <= probes.EXACT_RAD).to_numpy()
    matrices = np.array([probes.euler_B(R) for R in probes.rotations(frame)])
    at_poles = some(frame[is_pole], "exact pole")
    values = np.linalg.svd(matrices[is_pole], compute_uv=False)
    largest = float(np.abs(matrices).max())
    lacks_inverse = np.isfinite(matrices).all() and values[:, 2].max() < ON_POLE
    word = word_of(not np.isfinite(matrices[is_pole]).all(), lacks_inverse)
    so = "B exists everywhere, as 3.3 says; B^-1 does not" if lacks_inverse else "3.3 is not confirmed"
    return word, evidence(
        f"""B is finite at all {len(frame):,} orientations (elements at most {largest:.3f}); at {len(at_poles)} exact
        poles its smallest singular value is at most {float(values[:, 2].max()):.0e} and the next
        {float(values[:, 1].min()):.2f}. {so}.""",
        len(frame),
        ("episodes", "experiment"),
    )
