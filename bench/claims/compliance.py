"""C21 to C24: forces in Euler coordinates, and what complies by them in free space (Murphy 1988, 3.9-3.12)."""

from bench.claims.euler_jacobian import ROUNDINGS
from bench.claims.verdict import claim

TURNS = 2000
"""Haar-random orientations of each representation."""

LOST = 1e-12
"""Smallest singular value of B at a pole, and the size of what it leaves of the lost moment: rounding of pi/2."""

SAME = 0.01
"""Of two matrices of compliance, over the size of the reference: ten times the 1e-3 that a sampled plant leaves of the
closed form, and less than half of what one degree makes of an axis, sqrt(2) sin(1 deg) = 0.025."""

CLOSE_TO_POLE = 0.05
"""cos(beta) under which a pose is reported and does not decide: within 3 degrees of the pole B's condition number is
above 40 and the controller's failures are those of C18 and C20."""

APART_DEG = 1.0
"""An angle that is not zero is at least this; zero is below a billionth."""

LEAK, SMALL_DEG = 0.01, 5.0
"""Relative, of tan |beta|, or of tan 5 deg where that is more."""

PLANE_RAD = 0.005
"""rad, between measured and predicted tilt of a plane: a hand that turns by 3 mrad tilts its own axes by as much."""

NEAR_DEG, LITTLE = 15.0, 0.5
"""What 'near zero' is; and the share of the wanted compliance under which something is a problem."""

C21 = claim(
    id="C21",
    section="3.3",
    sentence="Measured forces can be converted by B transposed at every orientation, and work is conserved.",
    question="Does the power balance close over all poses, the poles included?",
    criterion=f"""
        Experiment, Z-Y-X angles: {TURNS:,} Haar-random orientations; both poles, exactly and at 10^-k rad from them,
        k = 1 to 12, each with random alpha and gamma; at each a random moment m and random rates Edot, of length 1.
        (a) Exists: F_E = B^T m is finite. (b) Work: |F_E . Edot - m . omega|, omega = B Edot (2.8), is at most
        {ROUNDINGS:g} eps. (c) The same with omega from central differences of R(E), which know no B, to {ROUNDINGS:g}
        eps^(2/3). (d) In the loop: in every row of wrench-probe of hybrid/zyx-euler in compliance.parquet that is done,
        the work residual, the largest |m . omega - F_E . Edot| over the largest |m| |omega|, is at most {ROUNDINGS:g}
        eps / cos(beta). It holds if all four pass everywhere; with a correction if they pass at every orientation but
        the exact poles; otherwise it does not hold. Reported: at the exact poles the rank of B and the moment that it
        loses, |B^T m| at most {LOST:g}; the same experiment in every other representation; and what (b) is for a moment
        that is not converted.
    """,
    open="""
        "Since the matrix B always exists ... Forces measured by the force wrist may always be converted to forces
        usable by the Euler Jacobian controller for every manipulator orientation." At a pole F_E exists, and one moment
        does not reach it: that it exists and balances the work of every motion of the angles is the reading judged. A
        turn about the lost moment's axis is no motion of the angles.
    """,
    readings=(
        "F_E exists and balances the work of every motion of the coordinates (decides)",
        "no moment is lost on the way (reported)",
    ),
)

C22 = claim(
    id="C22",
    section="3.3",
    sentence="With one compliant rotational axis, Euler and Cartesian compliance are the same.",
    question="Does a wrench probe, one axis at a time, see any difference, at zero angles and away from them?",
    criterion=f"""
        wrench-probe in compliance.parquet, orders 'about x', 'about y' and 'about z', every arm, pose and form with
        cos(beta) >= {CLOSE_TO_POLE:g}: the measured compliance c of hybrid/zyx-euler against that of hybrid-base. Same:
        |c - c'| <= {SAME:g} |c'| (Frobenius); a row that is not done is not. It holds if all are the same; with a
        correction if all are the same once the Cartesian compliance is turned by the rotations that come before it, c'
        -> Q c' Q^T with Q = 1 about z, Rz(alpha) about y and Rz(alpha) Ry(beta) about x: one compliant angle is then
        one compliant axis, but of the base only where the earlier angles are zero; otherwise it does not hold. Every
        axis must be there, x and y also with earlier angles of {APART_DEG:g} degree or more: else it is no evidence.
        Reported: how many are the same by axis; how many are the same as compliance about the hand's own x, y, z; how
        rows closer to the pole end.
    """,
    open="""
        "When only one rotational axis is in compliance, the effect is the same as compliance in the normal Cartesian
        space because, with Z-Y-X Euler angles, single Euler angle rotation corresponds to rotation about one of the x,
        y, z axes." Whose axes is not said: the base's are those of (2.1), in which the controller without the Euler
        Jacobian complies.
    """,
    readings=(
        "the x, y, z axes of the base frame (decides)",
        "those of the hand (reported)",
    ),
)

C23 = claim(
    id="C23",
    section="3.3",
    sentence="With two compliant rotational axes they do not correspond.",
    question="How far are the compliant planes apart, and how much leaks into the stiff axis?",
    criterion=f"""
        wrench-probe in compliance.parquet, the orders with two axes, every arm, pose and form with cos(beta) >=
        {CLOSE_TO_POLE:g}; same as in C22. A pose is general if alpha, beta and gamma all are {APART_DEG:g} degree or
        more from zero. (a) Apart: at every general pose and for every pair c of hybrid/zyx-euler and of hybrid-base are
        not the same. (b) As theory has it, at every pose, 'about x and y': the angle between both compliant planes (of
        the two greater singular values) is |beta| to {PLANE_RAD:g} rad, and of a moment about the level axis l = (cos
        alpha, sin alpha, 0), x where alpha = 0, the rotation about z over that about l, |c_zl / c_ll|, is tan |beta| to
        {LEAK:.0%}, of tan {SMALL_DEG:g} degrees where beta is less; with hybrid-base both are 0 to the same tolerance.
        It holds if (a) and (b) pass; with a correction if (a) passes at more than half of the general poses and pairs:
        they part, but not everywhere, or not as predicted; otherwise it does not hold. Reported: at which poses that
        are not general they correspond after all.
    """,
    open="""
        "However, when two rotational axes are to comply to external forces, Euler angle rotations and rotations about
        two of the x, y, z axes do not correspond." Where all angles are zero they do to first order, whatever the
        coordinates, and two axes are then told apart by finite rotations only: a general pose is what is judged.
    """,
)

C24 = claim(
    id="C24",
    section="3.3",
    sentence="Z-Y-Z angles are a problem where compliance about x is wanted.",
    question="What does a wrench probe about x see with Z-Y-Z angles at and near zero?",
    criterion=f"""
        wrench-probe in compliance.parquet, order 'about x', every arm and form: hybrid/zyz-euler, whose third angle is
        taken for the turn about x, against hybrid-base. A problem: it is not done, or its rotation about x per moment
        about x, c_xx, is less than {LITTLE:g} of that of hybrid-base. Poses: the identity, and all within
        {NEAR_DEG:g} degrees of it. It holds if there is a problem at all of them, and none with hybrid/zyx-euler; with
        a correction if there is a problem at some of them, or with hybrid/zyx-euler too; if there is none, it does not
        hold. Reported: c_xx over the wanted one, and c_zx, the rotation about z, over c_xx.
    """,
    open="""
        "Clearly compliance will be a problem if, for example, Z-Y-Z Euler angles are used and rotational compliance is
        desired about the x axis." Where is not said; zero is where 2.2 has the degeneracy. No Z-Y-Z angle is one about
        x: that the third stands for it is our choice, and with the first it would be the base's z at every orientation.
    """,
)

CLAIMS = (C21, C22, C23, C24)
