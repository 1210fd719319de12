"""The front page's box: the advised law with a link to its code, and every exception, as the rule says them."""

import pytest

from bench.experiments.tables.schema import RESULTS
from bench.export.subject import find_subject
from bench.findings.selection import needs
from report.figures.answer import answer_box

REFERENCE = RESULTS / "reference"


@pytest.fixture(scope="module")
def advice():
    return needs.advice(REFERENCE)


@pytest.fixture(scope="module")
def box(advice):
    return str(answer_box.box(advice))


def test_box_holds_the_formula_and_leads_to_the_code(box, advice):
    assert f'href="laws/{advice.default.law}.html"' in box
    assert find_subject(advice.default.law).record.formula in box


def test_box_names_each_exception_once(box, advice):
    words = [one.need.words for one in advice.exceptions if one.law]
    assert words
    assert [box.count(one) for one in words] == [1] * len(words)


def test_box_of_a_users_law_holds_exceptions_alone(advice):
    users = advice._replace(default=advice.default._replace(law="somebodys-law"))
    assert str(answer_box.box(users)) == answer_box.exceptions(users)


def test_box_without_a_law_is_none(advice):
    assert answer_box.box(advice._replace(default=advice.default._replace(law=None))) is None
