"""The texts of the laws' pages: one for every law, in plain words, with the constants of the law's file."""

import math
import re

import pytest

from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.findings.constants import CONSTANTS, HARDENING
from bench.law.contenders.registry import contenders
from bench.law.contenders.regulators import braking_cascade, late_braking, mrp_linearized
from bench.law.side import DELTA
from report.figures.cards import regulators
from report.figures.cards.card import set_paragraph

PRIVATE = re.compile(r"bench\.|[A-Z]{4,}|\btheta\b|\bacos\b|\basin\b|\bkept\b|\bticks?\b|\bdegrees\b|_")
ABBREVIATIONS = {"PX4"}
SHIPPED = {(constant.law, constant.symbol): constant.shipped for constant in CONSTANTS}


def test_every_law_of_the_reference_has_a_text_and_no_text_is_without_its_law():
    known = set(contenders("regulators"))
    in_reference = set(Run(RESULTS / "reference").table("costs")["regulator"].astype(str))
    assert known & in_reference <= set(regulators.TEXTS) <= known


@pytest.mark.parametrize("law", sorted(contenders("regulators")))
def test_card_of_every_law_says_what_it_is_and_where_it_fails(law):
    """A law that is newer than the texts is described in the words of its file."""
    about, limitations = regulators.text_of(contenders("regulators")[law])
    assert about.strip()
    assert limitations.endswith(".")


@pytest.mark.parametrize("law", sorted(regulators.TEXTS))
def test_text_of_a_law_has_no_word_of_its_code(law):
    about, limitations = regulators.text_of(contenders("regulators")[law])
    shown = "".join(set_paragraph(text) for text in (*about.split("\n\n"), limitations))
    words = re.sub(r"<[^>]+>", " ", shown)
    assert limitations.endswith(".")
    assert "<p></p>" not in shown
    assert not [word for word in PRIVATE.findall(words) if word not in ABBREVIATIONS]


def test_numbers_of_the_texts_are_those_of_the_laws():
    texts = {law: f"{text['about']} {text['limitations']}" for law, text in regulators.TEXTS.items()}
    beyond, at_switch = (round(2.0 * math.degrees(angle)) for angle in (math.asin(DELTA), math.acos(DELTA)))
    for law in ("hybrid", "mrp-memory", "rotation-vector-memory", "sliding-memory"):
        assert f"2 arcsin(δ) = {beyond}°" in texts[law]
        assert f"-δ = -{DELTA:g}" in texts[law]
    for law in ("mrp-memory", "rotation-vector-memory"):
        assert f"2 arccos(δ) = {at_switch}°" in texts[law]
    assert f"theta up to {round(2.0 * math.degrees(math.acos(-DELTA)))}°" in texts["rotation-vector-memory"]
    assert f"above {mrp_linearized.SWITCH:g}" in texts["mrp-linearized"]
    assert f"h = {SHIPPED['joshi-kelkar-wen', HARDENING]:g}:" in texts["joshi-kelkar-wen"]
    assert "a fifth of Kv at 180°" in texts["late-braking"]
    for law in ("braking-cascade", "braking-cascade-memory", "wie-bailey-heiberg", "wie-bailey-heiberg-memory"):
        assert f"{braking_cascade.SHARE:g} of the bound" in texts[law]
    assert pytest.approx(0.8) == late_braking.EASED


@pytest.mark.parametrize(
    ("share", "words"),
    [(0.0, "none of the situations"), (0.004, "less than 1 % of the situations"), (0.64, "64 % of the situations")],
)
def test_share_of_situations_is_said_in_words(share, words):
    assert regulators.say_share(share) == words
