"""How a law is drawn in every figure: words, which the book makes colours, markers and lines of."""

from typing import NamedTuple

COLOURS = ("blue", "vermillion", "green", "purple", "orange", "sky", "yellow")
"""Okabe and Ito's, distinguished with any colour vision."""
MARKERS = ("o", "s", "^", "v", "D", "d", "p", "P", "x", "X", "h", "*", "<")
LINES = ("solid", "dashed", "dotted", "dash-dot")


class Look(NamedTuple):
    """One of COLOURS, one of MARKERS, one of LINES."""

    colour: str
    marker: str
    line: str

    @property
    def is_known(self) -> bool:
        """Whether the book can draw it."""
        return self.colour in COLOURS and self.marker in MARKERS and self.line in LINES
