"""What a law's card shows besides its map: words, and the strip of what it bears."""

import re

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.contenders.registry import known_regulators, papers_laws
from report.figures.cards import card_parts, regulators


def test_strip_fills_a_level_where_enough_starts_go_well(monkeypatch):
    shares = pd.DataFrame({0.0: [1.0], 0.002: [0.95], 0.01: [0.5], 0.02: [0.0]}, index=["my-law"])
    monkeypatch.setattr(card_parts, "shares", lambda axis, run: shares if axis == "delay" else pd.DataFrame())
    found = card_parts.card_strip("my-law", None)
    cells = re.findall(r'<td class="([a-z ]+)" title="(\d+%) go well">([\d.]+)</td>', found)
    assert cells == [("well usual", "100%", "0"), ("well", "95%", "2"), ("part", "50%", "10"), ("lost", "0%", "20")]
    assert card_parts.card_strip("another-law", None) == ""


def test_cards_begin_with_the_papers_laws_and_end_with_later_ones():
    order = [one.name for one in regulators.in_order()]
    assert order[:3] == [one.regulator.name for one in papers_laws()]
    assert {one.later for one in known_regulators().values() if one.name == order[-1]} == {True}
    assert len(order) == len(set(order)) >= len(known_regulators())


def test_card_says_of_a_law_without_rows_whether_it_is_costed_only():
    known, none = known_regulators(), pd.DataFrame({"start_set": [], "outcome": []})
    assert regulators.measured(none, known["hybrid"]) == "Not in this run."
    assert regulators.measured(none, known["feedback-linearized-literal"]).startswith("Its price only")
