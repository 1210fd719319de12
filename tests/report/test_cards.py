"""What a law's card draws besides its map: the response, and the strip of what it bears."""

import math
import re

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.contenders.registry import known_regulators, papers_laws
from report.figures.cards import card_parts, regulators


def trace(start_id, angles):
    """Made-up samples of one start, five a second."""
    times = [0.2 * i for i in range(len(angles))]
    return pd.DataFrame({"start_id": start_id, "time_s": times, "angle_rad": [math.radians(one) for one in angles]})


def test_response_draws_the_starts_it_has_within_its_panel():
    seconds = 4.0
    long_one = trace("figure-2.3", [100.0] * round(5 * seconds))
    picture = card_parts.card_response(pd.concat([long_one, trace("half-turn-random0-k04", [180.0, 90.0])]), "A law")
    curves = re.findall(r'points="([^"]+)"', picture.wide)
    assert len(curves) == 2
    places = [tuple(map(float, point.split(","))) for curve in curves for point in curve.split()]
    assert all(card_parts.LEFT <= x <= card_parts.RIGHT for x, _ in places)
    assert all(card_parts.ABOVE <= y <= card_parts.BELOW for _, y in places)
    assert "180 at first, 90 at 0.2 s" in picture.alt


def test_response_stands_at_the_angle_and_time_of_its_axes():
    assert (card_parts.across(0.0), card_parts.across(card_parts.SHOWN_S)) == (38.0, 292.0)
    assert card_parts.up(0.0) == card_parts.BELOW
    assert card_parts.up(90.0) - card_parts.up(180.0) == pytest.approx(card_parts.BELOW - card_parts.up(90.0))


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
