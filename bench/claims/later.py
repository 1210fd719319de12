"""C21 to C25, C27: forces and the open question (Murphy 1988, 3.3 and 4), still to be measured."""

from bench.claims.verdict import Claim

COMING = "Stated with its measurements, before they are run."


def _later(id: str, section: str, sentence: str, question: str) -> Claim:
    return Claim(id, section, sentence, question, COMING)


CLAIMS = (
    _later(
        "C21",
        "3.3",
        "Measured forces can be converted by B transposed at every orientation, and work is conserved.",
        "Does the power balance close over all poses, the poles included?",
    ),
    _later(
        "C22",
        "3.3",
        "With one compliant rotational axis, Euler and Cartesian compliance are the same.",
        "Does a wrench probe, one axis at a time, see any difference, at zero angles and away from them?",
    ),
    _later(
        "C23",
        "3.3",
        "With two compliant rotational axes they do not correspond.",
        "How far are the compliant planes apart, and how much leaks into the stiff axis?",
    ),
    _later(
        "C24",
        "3.3",
        "Z-Y-Z angles are a problem where compliance about x is wanted.",
        "What does a wrench probe about x see with Z-Y-Z angles at and near zero?",
    ),
    _later(
        "C25",
        "3.3",
        "How well complex compliant motions go depends on the Jacobian used.",
        "Do contact tasks end differently with the two Jacobians?",
    ),
    _later(
        "C27",
        "4",
        "Open: a better regulator on the rotation matrix, and other representations.",
        "Which later law is adequate in both cost and performance by the criterion of C17?",
    ),
)
