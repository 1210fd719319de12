"""From the spelling of sources, which is plain, to that of a page: Greek letters, signs, powers, quotation marks."""

import html
import re

LETTERS = {"alpha": "α", "beta": "β", "gamma": "γ", "theta": "θ", "phi": "φ", "sigma": "σ", "tau": "τ"}
LETTERS |= {"omega": "ω", "pi": "π"}
RAISED = str.maketrans("0123456789-kT", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵏᵀ")
SCIENTIFIC = re.compile(r"(?<![\w.])(\d(?:\.\d+)?)e([+-]?\d+)(?!\w)")
# In this order: 1,200 is 1200, and 12,000 has a thin space.
THOUSANDS = (
    (r"(?<![\d,.])(\d),(\d{3})(?![\d,])", r"\1\2"),
    (r"(?<=\d),(?=\d{3}\b)", "\N{NARROW NO-BREAK SPACE}"),
)
# In this order.
SIGNS = (
    (rf"\b({'|'.join(LETTERS)})(?=\b|_)", lambda found: LETTERS[found[1]]),
    (r"\^(-?\d+|-k|T)(?!\w|\.\d)", lambda found: found[1].translate(RAISED)),
    (r"\+-", "±"),
    (r"-\+", "∓"),
    (r"<=", "≤"),
    (r">=", "≥"),
    (r"(?<=[\s(])-(?=\w)|(?<=[\w)|°²] )-(?= \S)", "−"),
    (r"(?<=\d )\*(?= \d)", "×"),
    (r"\.\.\.", "…"),
    # A thin space from 10,000 on; four figures stand together.
    *THOUSANDS,
    (r" deg\b", "°"),
    (r"(?<=\d) ?%", "\N{NO-BREAK SPACE}%"),
    (r"(?<=[\d⁰¹²³⁴⁵⁶⁷⁸⁹ᵏ]) (?=(?:rad|s|ms|µs|ns|mm)\b)|(?<=\bn) (?==)|(?<=\bn =) (?=\d)", "\N{NO-BREAK SPACE}"),
    # An absolute value and its comparison stay on one line.
    (r"\|(?=[α-ω]\|)", "|\N{WORD JOINER}"),
    (r"(?<=[α-ω]\|) (?=[<>≤≥])|(?<=[α-ω]\| [<>≤≥]) (?=\d)", "\N{NO-BREAK SPACE}"),
    (r"(?<![\w'])'(\w[^']*)'(?!\w)", r"‘\1’"),
    (r"\"([^\"]+)\"", r"“\1”"),
    (r"(?<=\w)'(?=\w)", "’"),
)
INDEX = re.compile(r"\b(\w)_([A-Za-z0-9])(?![A-Za-z0-9_])")
FRACTION = re.compile(r"\^\((\d+/\d+)\)")


def typeset(text: str) -> str:
    """Plain text with the letters, numbers and signs it names."""
    text = spell_powers(text)
    for pattern, sign in SIGNS:
        text = re.sub(pattern, sign, text)
    return text


def space_thousands(text: str) -> str:
    """Return a text whose numbers have no commas: 1,200 becomes 1200, and 12,000 gets a thin space."""
    for pattern, spaced in THOUSANDS:
        text = re.sub(pattern, spaced, text)
    return text


def spell_powers(text: str) -> str:
    """Return a text with its numbers in scientific notation as powers: 2.5e-07 becomes 2.5·10⁻⁷."""
    return SCIENTIFIC.sub(lambda found: raised(found[1], int(found[2])), text)


def power(value: float) -> str:
    """Return a number to one figure as a page spells it: 0.03, 2, 2·10⁻⁷."""
    text = f"{value:.0e}" if value and not 1e-3 <= abs(value) < 1e4 else f"{value:.1g}"
    mantissa, found, exponent = text.partition("e")
    return raised(mantissa, int(exponent)) if found else text


def raised(mantissa: str, exponent: int) -> str:
    """Mantissa times a power of ten: 2.5·10⁻⁷, 10⁶, 0."""
    if float(mantissa) == 0.0 or exponent == 0:
        return mantissa if float(mantissa) else "0"
    ten = f"10{str(exponent).translate(RAISED)}"
    return ten if mantissa == "1" else f"{mantissa}·{ten}"


def marked_up(text: str) -> str:
    """Typeset text as HTML, with indices of one letter, J_E, and fractions in powers, eps^(2/3)."""
    text = INDEX.sub(r"\1<sub>\2</sub>", html.escape(typeset(text), quote=False))
    return FRACTION.sub(r"<sup>\1</sup>", text)


def prose(text: str) -> str:
    """Typeset text as HTML for Markdown: escape the characters that Markdown would interpret."""
    return marked_up(text).replace("_", "\\_").replace("*", "\\*")
