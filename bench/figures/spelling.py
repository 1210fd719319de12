"""From the spelling of sources, which is plain, to that of a page: Greek letters, signs, small powers."""

from __future__ import annotations

import html
import re

LETTERS = {"alpha": "α", "beta": "β", "gamma": "γ", "theta": "θ", "omega": "ω", "pi": "π"}
WORDS = re.compile(rf"\b({'|'.join(LETTERS)})\b")
SIGNS = {"+-": "±", "-+": "∓"}
POWERS = {r"\^-1\b": "⁻¹", r"\^2\b": "²", r"\^T\b": "ᵀ", r" deg\b": "°"}


def typeset(text: str) -> str:
    """Plain text with the letters it names."""
    for pattern, sign in POWERS.items():
        text = re.sub(pattern, sign, text)
    for pair, sign in SIGNS.items():
        text = text.replace(pair, sign)
    return WORDS.sub(lambda found: LETTERS[found[1]], text)


def prose(text: str) -> str:
    """The same for Markdown: what it would take for its own is escaped."""
    return html.escape(typeset(text), quote=False).replace("_", "\\_").replace("*", "\\*")
