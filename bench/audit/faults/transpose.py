"""a matrix is transposed.

effect: if R is not near the identity, the command does not lead to the goal
cure: transpose only one of the two matrices: R_d R^T or R^T R_d; check whether a library stores matrices by columns
law: rotation-matrix
"""

from collections.abc import Iterator

from bench.audit.examined import Examined, Model, Symptom, explanation
from bench.audit.pairs import Pairs
from bench.audit.rotations import axis_of


def find(examined: Examined) -> Symptom | None:
    """Return the axis of a product with one transpose less; or, if both are stated, the other frame and direction."""
    stated, found = examined.stated, examined.convention
    if found and None not in (stated.frame, stated.sign) and (stated.frame, stated.sign) != (found.frame, found.sign):
        return None if stated.frame == found.frame or stated.sign == found.sign else Symptom(
            "frame and direction are both the other than stated: both matrices are transposed, as those of a library "
            "that stores columns are when they are read by rows"
        )  # fmt: skip
    return explanation(examined, models, "e lies along the axis of {}", right=True)


def models(pairs: Pairs) -> Iterator[Model]:
    """Products of two rotations without a transpose; with two the line is that of the other order."""
    yield "R_d R, not of R_d R^T", axis_of(pairs.R_d @ pairs.R)
    yield "R R_d, not of R^T R_d", axis_of(pairs.R @ pairs.R_d)
