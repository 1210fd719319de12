"""In which order the cards of laws stand, and what they say of laws without rows."""

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.contenders.registry import known_regulators, papers_laws
from report.figures.cards import regulators


def test_cards_begin_with_the_papers_laws_and_end_with_later_ones():
    order = [one.name for one in regulators.in_order()]
    assert order[:3] == [one.regulator.name for one in papers_laws()]
    assert {one.later for one in known_regulators().values() if one.name == order[-1]} == {True}
    assert len(order) == len(set(order)) >= len(known_regulators())


def test_card_says_of_a_law_without_rows_whether_it_is_costed_only():
    known, none = known_regulators(), pd.DataFrame({"start_set": [], "outcome": []})
    assert regulators.measured(none, known["hybrid"]) == "Not in this run."
    assert regulators.measured(none, known["feedback-linearized-literal"]).startswith("Its price only")
