"""Spell signs that ASCII lacks: 1/√kp as 1/sqrt(kp), rad/s² as rad/s^2, 180° as 180 deg.

A stream whose encoding lacks a sign would print a question mark in its place: a wrong unit.
"""

import codecs
import io
import re
import unicodedata
from typing import TextIO

RULE = "spell"
"""Name of the rule for signs that an encoding lacks, as `replace` is one."""

SPELLED = {
    **{"°": "deg", "√": "sqrt", "±": "+-", "×": "x", "·": "*", "…": "..."},
    **{"−": "-", "–": "-", "—": "-", "‐": "-", "‑": "-"},
    **{"≤": "<=", "≥": ">=", "≈": "~", "≠": "!=", "∞": "inf", "→": "->", "←": "<-", "∈": "in"},
    **{"‘": "'", "’": "'", "“": '"', "”": '"', "′": "'", "µ": "u", "ᵀ": "^T", "⁻": "^-", "‖": "||"},
    **{"Ė": "E_dot", "\N{COMBINING DOT ABOVE}": "_dot"},
}
SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789", strict=True))
SUBSCRIPTS = dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True))

SIGN = re.compile(
    r"(?P<root>√)(?P<under>\w+)"  # √kp, but not √(K I), whose brackets are there
    r"|(?P<degrees>(?<=\d)°)"
    r"|(?P<power>[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)"
    r"|[^\x00-\x7f]"
)


def spell(text: str) -> str:
    """Return a text in ASCII, each sign that ASCII lacks spelled; a sign without a spelling becomes a question mark."""
    return text if text.isascii() else SIGN.sub(_spell_match, text)


def can_print_signs(stream: TextIO) -> bool:
    """Tell whether a stream can print every sign: whether it is encoded as UTF."""
    return (getattr(stream, "encoding", None) or "utf-8").lower().startswith("utf")


def spell_where_needed(*streams: TextIO) -> None:
    """Make streams spell what their encoding lacks."""
    codecs.register_error(RULE, _spell_rest)
    for stream in streams:
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=RULE)


def _spell_match(sign: re.Match[str]) -> str:
    if sign["root"]:
        return f"sqrt({spell(sign['under'])})"
    if sign["degrees"]:
        return " deg"
    if sign["power"]:
        return "^" + "".join(SUPERSCRIPTS.get(each, "-") for each in sign["power"])
    return _spell_one(sign[0])


def _spell_one(sign: str) -> str:
    known = SPELLED.get(sign) or SUBSCRIPTS.get(sign)
    if known:
        return known
    name = unicodedata.name(sign, "")
    if name.startswith("GREEK SMALL LETTER "):
        return name.split()[3].lower().replace("lamda", "lambda")
    if name.startswith("GREEK CAPITAL LETTER "):
        return name.split()[3].capitalize().replace("Lamda", "Lambda")
    if "SPACE" in name or name.startswith("BRAILLE"):  # the signs of a spinner
        return " "
    base = unicodedata.normalize("NFKD", sign)[0]
    return base if base.isascii() else "?"


def _spell_rest(error: UnicodeError) -> tuple[str, int]:
    """Return the spelling of the first sign that cannot be encoded, and where to go on: a codec's rule for errors."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    sign = SIGN.match(error.object, error.start)
    if sign is None:  # a byte that is no text, kept by surrogateescape
        return "?", error.start + 1
    return _spell_match(sign), sign.end()
