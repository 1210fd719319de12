"""The front page's box: the advised law with a link to its code, and what leads to another law."""

import pytest

from bench.experiments.tables.schema import RESULTS
from bench.export.subject import find_subject
from bench.findings.selection.regions import find_default
from bench.findings.selection.robots import ROBOTS, list_elsewhere
from report.figures.answer import answer_box
from report.figures.kit.page import run_in

REFERENCE = RESULTS / "reference"


@pytest.fixture(scope="module")
def box():
    return str(answer_box.answer(run_in(REFERENCE)))


def test_box_holds_the_formula_and_leads_to_the_code(box):
    assert f'href="laws/{find_default()}.html"' in box
    assert find_subject(find_default()).record.formula in box


def test_box_names_every_need_that_leads_to_another_law(box):
    found = list_elsewhere(REFERENCE)
    assert {robot.takes in " ".join(one.words for one in found) for robot in ROBOTS.values()} == {True}
    for words, law in ((one.words, one.law) for one in found):
        lines = [line for line in box.splitlines() if words in line]
        assert [f"laws/{law}.html" in line for line in lines] == [True] * (law != find_default())
