"""C13 to C16: where coordinates of a rotation break down (Murphy 1988, 2.2, 2.3 and 3.3)."""

from bench.claims.verdict import claim

DECADES = (1, 6)
DEGENERATE, SMOOTH = 0.9, 0.01
ON_POLE, OFF_POLE, SAME = 1e-12, 0.99, 1e-12

C13 = claim(
    id="C13",
    section="2.2",
    sentence="""
        Z-Y-Z Euler angles and equivalent angle-axis are degenerate at zero rotation: unfit to regulate
        about it.
    """,
    question="""
        How does the map from coordinate rates to angular velocity behave at rotations of 10^-k rad?
    """,
    criterion=f"""
        Condition number of that map at rotations of 10^-k rad, k = {DECADES[0]} to {DECADES[1]}, about 12
        directions. Degenerate: log10 of the condition number rises by at least {DEGENERATE} per decade.
        Smooth: it is within {SMOOTH:.0%} of 1 throughout. Judged on Z-Y-Z; on angle and axis (angle and
        two angles of a unit axis); and on the rotation vector (axis times angle). It holds if all three
        are degenerate; with a correction if Z-Y-Z is, and exactly one of the other two; otherwise it does
        not hold.
    """,
    open="""
        The paper does not say whether angle-axis means angle and axis kept apart or their product: its
        source has both.
    """,
    readings=(
        "angle and axis kept apart",
        "the rotation vector, axis times angle",
    ),
)

C14 = claim(
    id="C14",
    section="2.2 against 2.3",
    sentence="With Z-Y-X angles the degeneracy is at a rotation of 180 degrees about Y.",
    question="Is the degenerate rotation about Y one of 180 degrees, or of 90 as the equations have it?",
    criterion=f"""
        Smallest singular value of B (2.8) at rotations of 180, 90 and -90 degrees about Y. It holds if it
        is below {ON_POLE:g} at 180 degrees; it does not hold if it is below that at both +-90 degrees and
        above {OFF_POLE} at 180; in any other case it holds with a correction. The exact half turn about y
        of the set half-turn and the exact poles say the same from simulation: whether the
        feedback-linearized law settles from them is reported.
    """,
    open="Nothing.",
)

C15 = claim(
    id="C15",
    section="2.2",
    sentence="At beta = +-pi/2 only the sum of alpha and gamma is determined.",
    question="Is it the sum at both poles?",
    criterion=f"""
        At each pole, over 64 pairs (alpha, gamma): R is the same (to {SAME:g}) if alpha grows and gamma
        falls by one amount (the sum kept), and differs if both grow. It holds if so at both poles; with a
        correction if at exactly one (the difference at the other); otherwise it does not hold.
    """,
    open="Nothing; it follows from the convention of (2.8).",
)

C16 = claim(
    id="C16",
    section="2.2 against 3.3",
    sentence="B does not exist at beta = +-pi/2 (2.2); B always exists (3.3).",
    question="Which of the two sentences do B and its inverse support?",
    criterion=f"""
        B (2.8) over the run's orientations and the exact poles. The sentence of 2.2 holds if an element
        of B is not finite at a pole; it holds with a correction if B is finite at every orientation
        (elements at most 1) but of rank 2 at both poles (smallest singular value below {ON_POLE:g}), so
        that B^-1 is what does not exist and 3.3 is right; it does not hold if B is finite and of rank 3
        at a pole.
    """,
    open="Nothing.",
)

CLAIMS = (C13, C14, C15, C16)
