"""The live page: laws, starts and presets that exist, controls with names, and costs of the run."""

import json
import math
import re
from urllib.parse import parse_qs

import pandas as pd
import pytest
from bs4 import BeautifulSoup

from bench.engines import counting
from bench.experiments.tables.run import with_contender
from bench.law.contenders.registry import find_contender
from report.figures.cards import live
from report.figures.kit import style

LAWS = ("rotation-matrix", "mrp-memory", "feedback-linearized/zyx-euler")


@pytest.fixture(scope="module")
def page():
    contenders = [find_contender(name) for name in LAWS]
    return live.page(contenders, with_contender(pd.DataFrame(counting.rows(contenders))))


@pytest.fixture(scope="module")
def data(page):
    return json.loads(re.search(r'<script type="application/json" id="live-data">(.*?)</script>', page, re.DOTALL)[1])


@pytest.fixture(scope="module")
def parsed(page):
    return BeautifulSoup(page, "html.parser")


def test_every_law_and_every_start_can_be_chosen(parsed, data):
    options = {word: [one["value"] for one in parsed.select(f"#live-{word} option")] for word in ("a", "b", "start")}
    assert set(options["a"]) == set(options["b"]) == set(LAWS) == set(data["laws"])
    assert options["start"] == [*(one["id"] for one in data["starts"]), "own"]


def test_presets_name_laws_and_starts_that_there_are(data):
    ours = {one.on_free_body for one in live.alive(())}
    starts = {one["id"] for one in data["starts"]}
    for one in live.PRESETS.values():
        assert {one["a"], one["b"]} <= ours
        assert parse_qs(one["rest"])["start"][0] in starts


def test_second_of_two_grey_laws_has_another_neutral(data):
    greys = [law["colour"] for law in data["laws"].values()] + [[style.REST, style.TWINS[style.REST]]]
    for colour in greys:
        assert next(one for one in data["neutrals"] if one[0] != colour[0]) != colour


def test_preset_of_a_law_that_is_not_there_is_left_out(parsed):
    assert [button["data-preset"] for button in parsed.select("[data-preset]")] == ["slow", "stuck"]
    assert all(parsed.find(id=word) for word in ("slow", "stuck"))


def test_every_control_and_drawing_has_a_name(parsed):
    named = {label.get("for") for label in parsed.select("label")}
    for one in parsed.select("select, input, canvas, svg, button[id]"):
        own = one.get_text(strip=True) if one.name == "button" else one.find_parent("label")
        assert one.get("aria-label") or one["id"] in named or own, one["id"]


def test_costs_are_the_runs(data):
    assert data["laws"]["rotation-matrix"]["cost"] == "43 flops, 0 calls"


@pytest.mark.parametrize(
    ("from_half_turn", "words"),
    [(0.0, "180°"), (1e-4, "179.994°"), (1e-2, "179.4°"), (2.0, "65°"), (math.pi, "0°")],
)
def test_degrees_tell_an_angle_from_half_a_turn(from_half_turn, words):
    assert live.degrees(math.pi - from_half_turn) == words
