"""C18, C19: the Euler Jacobian J_E, its singularities and its two derivations (Murphy 1988, 3.1-3.5)."""

from bench.claims.verdict import claim

WELL_CONDITIONED = 50.0
"""Condition number of J, in metres and radians, up to which the manipulator is not to blame: six times the 7.9 of the
PUMA's stock pose; a milliradian off a wrist singularity it is in the thousands."""

SLOPE, SLOPE_TIGHT, SLOPE_LOOSE = 1.0, 0.05, 0.5
"""Decades a decade. cond B = (1 + |sin beta|)/cos beta is 2/d to a relative d^2 at a distance d; the constant between
it and J_E, at most cond J, bends the first decade or two. 5 % of a fit over 8 decades is a factor of 2.5 in all."""

UNBOUNDED, NEAREST = 1e10, 12
"""Largest element at 10^-12 from the pole: 1/d, less a factor 100 for J's own elements."""

EPS = 2.0**-52
ROUNDINGS = 100.0
"""A determinant or a product of 6 x 6 sums 36 rounded terms; R itself is orthonormal to a few eps only. What is
divided by cos(beta) errs by as many eps over the margin."""

DETERMINANT_LOOSE, AWAY, NEAR = 1e-6, 1e-3, 1e-6
"""The margin cos(beta) from which on an agreement is asked at all (NEAR), and without which there is none (AWAY)."""

DIFFERENCED = EPS ** (2 / 3)
"""What a central difference keeps: with a step of eps^(1/3) times the margin, truncation (step/margin)^2/3 and
rounding eps/step are both about eps^(2/3), over the margin."""

C18 = claim(
    id="C18",
    section="3.1",
    sentence="""
        The Euler Jacobian adds singularities of its own, with unbounded elements, to those of the manipulator.
    """,
    question="Does J_E grow without bound where J is well conditioned, and is it singular wherever J is?",
    criterion=f"""
        poses.parquet, Z-Y-X angles, every arm. A family is one arm posture brought to distances 10^-k from beta =
        +-pi/2; it speaks if J's condition number (metres, radians) is at most {WELL_CONDITIONED:g} at every k. (a) Own
        singularities: over k = 1 to 8, the least-squares slopes of log10 of J_E's condition number and of its largest
        element (orientation rows) are {SLOPE:g} +- {SLOPE_TIGHT:.0%} decades a decade. (b) Unbounded: at k = {NEAREST}
        the largest element is {UNBOUNDED:g} or more. (c) The manipulator's: on six joints, at every pose with cos(beta)
        >= {NEAR:g}, det J_E = -det J / cos(beta) to {ROUNDINGS:g} eps / cos(beta) of the product of J_E's row norms,
        so that det J_E is zero exactly where det J is. It holds if every family of every arm passes (a) and (b) and
        every pose (c); with a correction if every slope is at least {SLOPE_LOOSE:g} and (c) holds to
        {DETERMINANT_LOOSE:g}: it is singular, but not like 1/d; otherwise it does not hold. An arm without a family
        is no evidence.
    """,
    open="""
        "... it has the property of being zero at points in the workspace as well as being undefined, or having elements
        values approaching infinity, at other points in the workspace." No matrix of an arm with hinges is zero: zero is
        read of the determinant, and the smallest value that the largest element takes over all poses is reported.
        Families, arms and distances are ours.
    """,
    readings=(
        "'zero' of the determinant: singular (decides)",
        "'zero' of every element (reported)",
    ),
)

C19 = claim(
    id="C19",
    section="3.1",
    sentence="Its two derivations agree: diag(I, B^-1) J, and the derivative of the forward kinematics.",
    question="Are (3.3) and (3.5) the same matrix, and that of the differentiated forward kinematics?",
    criterion=f"""
        poses.parquet, Z-Y-X angles, every arm, every pose with cos(beta) >= {NEAR:g}. The gap of two matrices is the
        largest difference of elements over the largest element. (a) Derivations: the gap between (3.3) and (3.5), the
        extraction differentiated element by element, is at most {ROUNDINGS:g} eps / cos(beta). (b) Differentiation: the
        gap between (3.3) and central differences of the judge's forward kinematics is at most {ROUNDINGS:g} eps^(2/3) /
        cos(beta). It holds if every pose passes both; with a correction if every pose with cos(beta) >= {AWAY:g} does:
        they part near the pole; otherwise it does not hold.
    """,
    open="""
        "The function is differentiated with respect to the joint angles and the resultant matrix is the manipulator
        Jacobian with respect to Euler angles." and "This Jacobian has the same properties as that presented in the
        previous section". The paper states the equality and does not show it; tolerances are ours.
    """,
)

CLAIMS = (C18, C19)
