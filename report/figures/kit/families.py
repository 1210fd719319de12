"""The laws in families, each small enough for one panel, with names short enough to stand beside a curve.

Two dozen laws in one figure are told apart by nothing. A family's laws are drawn in their own colours over all
others in grey.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from report.figures.kit import html

CARDS = "03-regulators.html"
OTHERS = "Others"
"""The family of a law that none names: a user's own, or a new one."""


class Family(NamedTuple):
    """A title, and its laws: contender -> what it is called beside a curve."""

    title: str
    laws: dict[str, str]


FAMILIES = (
    Family(
        "The paper's three",
        {
            "rotation-matrix": "rotation matrix",
            "linearized-euler/zyx-euler": "linearized Euler",
            "feedback-linearized/zyx-euler": "feedback-linearized",
        },
    ),
    Family(
        "On the matrix",
        {"weighted-columns": "weighted columns", "square-root": "square root", "late-braking": "late braking"},
    ),
    Family(
        "On the quaternion",
        {
            "quaternion-shortest": "shortest quaternion",
            "hybrid": "hybrid",
            "sliding": "sliding",
            "paielli-bach": "Paielli, Bach",
        },
    ),
    Family(
        "On three parameters",
        {
            "rotation-vector": "rotation vector",
            "in-engine": "MuJoCo's actuator",
            "mrp": "MRP",
            "gibbs": "Gibbs",
            "mrp-linearized": "MRP made linear",
        },
    ),
    Family(
        "Feedback-linearized elsewhere",
        {
            "feedback-linearized/mrp": "in MRP",
            "feedback-linearized/rotation-vector": "in rotation vectors",
            "feedback-linearized/quaternion": "in quaternions",
            "feedback-linearized/xyz-euler": "in X-Y-Z angles",
            "feedback-linearized/zyz-euler": "in Z-Y-Z angles",
        },
    ),
    Family(
        "Euler variants, controls",
        {
            "linearized-euler-relative/zyx-euler": "linearized, from goal",
            "euler-gradient/zyx-euler": "Euler gradient",
            "linearized-euler-literal/zyx-euler": "control: literal",
            "quaternion-unwinding": "control: no sign",
        },
    ),
)

CONTROLS = ("linearized-euler-literal/zyx-euler", "quaternion-unwinding")
"""Negative controls: laws that are here because they must fail."""


def present(names: Iterable[str]) -> list[Family]:
    """The families, with those of their laws that occur in `names`; at the end what no family names."""
    left = set(names)
    found = [Family(one.title, {name: word for name, word in one.laws.items() if name in left}) for one in FAMILIES]
    others = left - {name for one in FAMILIES for name in one.laws}
    found.append(Family(OTHERS, {name: name for name in sorted(others)}))
    return [one for one in found if one.laws]


def in_order(names: Iterable[str]) -> list[str]:
    """The names, family by family."""
    return [name for one in present(names) for name in one.laws]


def word(name: str) -> str:
    """What a law is called where its family is not said too."""
    short = present([name])[0].laws[name]
    return f"feedback-linearized {short}" if short.startswith("in ") else short


def anchor(name: str) -> str:
    """The id of a law's card on its page."""
    return name.replace("/", "-")


def link(name: str, text: str) -> html.Html:
    """A law by this text, leading to its card."""
    return html.Html(f'<a href="{CARDS}#{anchor(name)}">{html.law(name, text)}</a>')
