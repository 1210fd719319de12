"""C27: the open question (Murphy 1988, 4), still to be measured."""

from bench.claims.verdict import Claim

COMING = "Stated with its measurements, before they are run."

CLAIMS = (
    Claim(
        "C27",
        "4",
        "Open: a better regulator on the rotation matrix, and other representations.",
        "Which later law is adequate in both cost and performance by the criterion of C17?",
        COMING,
    ),
)
