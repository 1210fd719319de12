"""From the spelling of sources, which is plain, to that of a page: Greek letters, signs, small powers."""

from __future__ import annotations

import html
import re

LETTERS = {"alpha": "α", "beta": "β", "gamma": "γ", "theta": "θ", "omega": "ω", "pi": "π"}
WORDS = re.compile(rf"\b({'|'.join(LETTERS)})\b")
SIGNS = {"+-": "±", "-+": "∓"}
POWERS = {r"\^-1\b": "⁻¹", r"\^2\b": "²", r"\^3\b": "³", r"\^-k\b": "⁻ᵏ", r"\^T\b": "ᵀ", r" deg\b": "°"}
RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def typeset(text: str) -> str:
    """Plain text with the letters it names."""
    text = WORDS.sub(lambda found: LETTERS[found[1]], text)
    for pattern, sign in POWERS.items():
        text = re.sub(pattern, sign, text)
    for pair, sign in SIGNS.items():
        text = text.replace(pair, sign)
    return text


def power(value: float) -> str:
    """A number to one figure as a page spells it: 0.03, 2, 2·10⁻⁷."""
    text = f"{value:.0e}" if value and not 1e-3 <= abs(value) < 1e4 else f"{value:.1g}"
    mantissa, found, exponent = text.partition("e")
    if not found:
        return text
    raised = f"10{str(int(exponent)).translate(RAISED)}"
    return raised if mantissa == "1" else f"{mantissa}·{raised}"


def prose(text: str) -> str:
    """The same for Markdown: what it would take for its own is escaped."""
    return html.escape(typeset(text), quote=False).replace("_", "\\_").replace("*", "\\*")
