"""Formulas of the pages as MathML, and what of TeX is refused."""

from xml.etree import ElementTree

import pytest

from bench.law.contenders.registry import all_contenders
from report.figures.kit import html, mathml


def words(made: str) -> str:
    """All that is written in a formula, without spaces."""
    return "".join("".join(ElementTree.fromstring(made).itertext()).split())


@pytest.mark.parametrize(
    ("tex", "read"),
    [
        (r"J^\top K", "J⊤K"),
        (r"\tfrac{1}{2}\omega", "12ω"),
        (r"\operatorname{sign}(w)", "sign(w)"),
        (r"\begin{aligned} a &= b \cr c &= d \end{aligned}", "a=bc=d"),
        (r"\bigl( x \bigr)", "(x)"),
    ],
)
def test_formula_reads_as_its_tex(tex, read):
    assert words(mathml.inline(tex)) == read


def test_number_of_a_formula_stands_beside_it():
    assert mathml.block(r"\tau = J^\top F, \tag{2.2}").endswith('<span class="eqno">(2.2)</span></div>')


def test_name_of_a_function_is_set_apart_from_its_factor_and_not_from_its_bracket():
    row = ElementTree.fromstring(mathml.inline(r"2 \sin(x)"))[0]
    assert [mathml.kind(child) for child in row][:4] == ["mn", "mspace", "mi", "mo"]


def test_sign_after_a_relation_is_no_difference():
    row = ElementTree.fromstring(mathml.inline(r"a = -b - c"))[0]
    assert [child.get("form") for child in row if child.text == "\u2212"] == ["prefix", None]


@pytest.mark.parametrize("tex", [r"\nosuchcommand x", r"\left( x", "x^2^3", "a & b"])
def test_what_cannot_be_set_is_an_error(tex):
    with pytest.raises(ValueError, match="no MathML for the formula"):
        mathml.inline(tex)


def test_formula_of_a_user_that_cannot_be_set_stands_as_it_is_written():
    assert "&#92;nosuchcommand x" in html.formula(r"\nosuchcommand x")


def test_every_formula_of_a_law_is_set():
    shown = {one.regulator.formula for one in all_contenders() if one.regulator.formula}
    assert len(shown) > 10
    assert [tex for tex in shown if "<code>" in html.formula(tex)] == []
