"""Attribution of a law: published, adapted or ours. Every contender that is shipped here says one of the three.

published   one cited work has this very law. Constants that the work leaves open, or that we chose, are named in the
            same line: "Schaub, Akella, Junkins 2001; the switch at |sigma|^2 = 1.5 is ours".
            A work that nobody here has opened is marked in the book's references: its law is as later texts state it.
adapted     parts of published works, combined or changed here: "after A and B". No cited work has this very law, or
            the law of the nearest work is not known here, so that it cannot be said whether it is the same.
ours        the law was made here and nobody else has reviewed it: "this benchmark, 2026".
yours       the law of a user's file, whatever the file says: nobody here has compared it with a work.

A law of ours is never advised. An adapted one may be, and is called adapted wherever it is.
"""

PUBLISHED = "published"
ADAPTED = "adapted"
OURS = "ours"
YOURS = "yours"

SHIPPED_ATTRIBUTIONS = (PUBLISHED, ADAPTED, OURS)
"""What a contender of this repository may say of itself."""

IN_WORDS = {
    PUBLISHED: "a published law",
    ADAPTED: "an adapted law (published parts, combined or changed here)",
    OURS: "a law of ours (simulation only, not reviewed)",
    YOURS: "your law",
}
"""What a sentence calls a law. Sentences, cards and headings take the words from here and nowhere else."""

THIS_BENCHMARK = "this benchmark"
"""How the source of a law of ours begins."""

AFTER = "after "
"""How the source of an adapted law begins."""


def describe_source(attribution: str, source: str) -> str:
    """Return whose something is, and its source: "adapted: after A and B"."""
    if attribution == ADAPTED and not source.startswith(AFTER):
        # A published law in coordinates that its work does not use.
        return f"{attribution}: {AFTER}{source}"
    return f"{attribution}: {source}"
