"""Formulas from TeX to MathML when the book is built, so that a page needs no script for them."""

import re
from collections.abc import Iterator
from xml.etree import ElementTree

NAMESPACE = "http://www.w3.org/1998/Math/MathML"
TAG = re.compile(r"\s*\\tag\{([^}]*)\}")
# The TeX of our pages that latex2mathml knows by another name.
OTHER_NAMES = {
    r"\cr": r"\\",
    r"\bigl": r"\big",
    r"\bigr": r"\big",
    r"\Bigl": r"\Big",
    r"\Bigr": r"\Big",
    "{aligned}": "{align*}",
}
RENAMED = re.compile("|".join(re.escape(name) + r"(?![A-Za-z])" for name in OTHER_NAMES))
THIN = "0.167em"
SIGNS = {"+", "\u2212", "\u00b1", "\u2213"}
CLOSING = {")", "]", "}", "|", "!", "\u2032"}
WITHOUT_SPACE = {"/", "|"}
TRANSPOSE = "\u22a4"
SCRIPTED = {"msup", "msub", "msubsup", "munder"}


def inline(tex: str) -> str:
    """Return a formula within a line."""
    return converted(tex, "inline")


def block(tex: str) -> str:
    """Return a formula on a line of its own, its number to the right where the TeX has a tag."""
    tag = TAG.search(tex)
    number = f'<span class="eqno">({tag[1]})</span>' if tag else ""
    return f'<div class="math">{converted(TAG.sub("", tex), "block")}{number}</div>'


def converted(tex: str, display: str) -> str:
    """Return MathML of a formula; ValueError if it is no TeX, or holds a command that would stand as text."""
    from latex2mathml import converter

    try:
        made = converter.convert(RENAMED.sub(lambda name: OTHER_NAMES[name[0]], tex.strip()), display=display)
        root = ElementTree.fromstring(made)
    except Exception as error:  # the library's dozen errors have no base of their own
        raise ValueError(f"no MathML for the formula {tex!r}: {type(error).__name__} {error}") from error
    if "\\" in made:
        raise ValueError(f"no MathML for the formula {tex!r}: {made} (cure: other TeX, or a line in OTHER_NAMES)")
    ElementTree.register_namespace("", NAMESPACE)
    for element in list(root.iter()):
        space(element)
    return ElementTree.tostring(root, encoding="unicode")


def space(row: ElementTree.Element) -> None:
    """Set the children of a row apart as TeX does: names of functions, signs, bars and slashes."""
    if kind(row) == "mover":
        row.set("accent", "true")
    if kind(row) not in ("mrow", "mstyle", "mtd", "math", "msqrt"):
        return
    for child in row:
        if kind(child) == "mo" and ((child.text or "").isalpha() or child.text == TRANSPOSE):
            child.tag = f"{{{NAMESPACE}}}mi"  # as an operator a browser would set it apart on both sides
    row[:] = list(set_apart(list(row)))


def set_apart(children: list[ElementTree.Element]) -> Iterator[ElementTree.Element]:
    """Yield the children with what belongs between them."""
    for before, child, after in zip([None, *children], children, [*children[1:], None], strict=False):
        text = child.text or ""
        if kind(child) == "mo" and text in WITHOUT_SPACE:
            child.set("lspace", "0")
            child.set("rspace", "0")
        if kind(child) == "mo" and text in SIGNS and not is_operand(before):
            child.set("form", "prefix")
        if is_function(child) and is_operand(before):
            yield thin_space()
        yield child
        if is_function(child) and after is not None and kind(after) not in ("mo", "mspace") and not is_function(after):
            yield thin_space()


def kind(element: ElementTree.Element) -> str:
    """Its tag without the namespace."""
    return element.tag.rpartition("}")[2]


def is_operand(element: ElementTree.Element | None) -> bool:
    """Whether a sign that follows it has two sides."""
    if element is None or kind(element) == "mspace":
        return False
    return kind(element) != "mo" or (element.text or "") in CLOSING


def is_function(element: ElementTree.Element) -> bool:
    """Whether it is a name such as sin, with or without a power or an index."""
    if kind(element) in SCRIPTED:
        return is_function(element[0])
    return kind(element) == "mi" and len(element.text or "") > 1 and (element.text or "").isalpha()


def thin_space() -> ElementTree.Element:
    """Return what stands between a function's name and its argument."""
    return ElementTree.Element(f"{{{NAMESPACE}}}mspace", {"width": THIN})
