"""Colour is identity: eight laws have one each, told apart by any eye on both pages, and nobody else writes one."""

import itertools
import re

import numpy as np
import pytest

from bench.findings.selection.regions import find_default
from bench.law.contenders.registry import contenders, papers_laws
from report.figures.cards import live
from report.figures.kit import laws, style
from report.figures.kit.page import REPORT

PAGES = {"light": "#ffffff", "dark": "#14181e"}
LEAST_CONTRAST = 3.0
"""Contrast of graphics to their page (WCAG 2.2, 1.4.11)."""
LEAST_DISTANCE = 0.07
"""In OKLab, where 0.02 is just visible side by side; lines and dots that are apart need more."""

# Machado, Oliveira and Fernandes 2009, severity 1, on linear RGB.
EYES = {
    "usual": np.eye(3),
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
# Ottosson 2020: linear RGB to cones, and the cones' cube roots to OKLab.
CONES = [
    [0.4122214708, 0.5363325363, 0.0514459929],
    [0.2119034982, 0.6806995451, 0.1073969566],
    [0.0883024619, 0.2817188376, 0.6299787005],
]
LAB = [
    [0.2104542553, 0.7936177850, -0.0040720468],
    [1.9779984951, -2.4285922050, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.8086757660],
]
LUMINANCE = [0.2126, 0.7152, 0.0722]

HEX = re.compile(r"#[0-9a-fA-F]{6}\b")


def linear(colour):
    values = np.array([int(colour[place : place + 2], 16) / 255.0 for place in (1, 3, 5)])
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def perceived(colour, eye):
    seen = np.clip(np.array(eye) @ linear(colour), 0.0, 1.0)
    return np.array(LAB) @ np.cbrt(np.array(CONES) @ seen)


def contrast(colour, page):
    low, high = sorted(float(np.dot(LUMINANCE, linear(one))) for one in (colour, page))
    return (high + 0.05) / (low + 0.05)


def colours_on(page):
    """Return name -> colour of the eight laws and of the grey of all others, on a light or a dark page."""
    light = {**style.LAW_COLOURS, "the others": style.REST}
    return light if page == "light" else {name: style.TWINS[colour] for name, colour in light.items()}


def test_measures_of_colour_are_those_of_their_authors():
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    np.testing.assert_allclose(perceived("#ff0000", EYES["usual"]), [0.62796, 0.22486, 0.12585], atol=1e-4)
    for eye in EYES.values():
        np.testing.assert_allclose(np.array(eye) @ np.ones(3), np.ones(3), atol=1e-5)


@pytest.mark.parametrize("eye", EYES)
@pytest.mark.parametrize("page", PAGES)
def test_no_two_laws_and_no_law_and_the_grey_look_alike(page, eye):
    for (law, colour), (other, theirs) in itertools.combinations(colours_on(page).items(), 2):
        distance = np.linalg.norm(perceived(colour, EYES[eye]) - perceived(theirs, EYES[eye]))
        assert distance >= LEAST_DISTANCE, (law, other)


@pytest.mark.parametrize("page", PAGES)
def test_every_law_stands_out_from_its_page(page):
    for name, colour in colours_on(page).items():
        assert contrast(colour, PAGES[page]) >= LEAST_CONTRAST, name


def test_argued_laws_are_the_papers_the_advised_and_ours_and_their_files_say_the_same_colour():
    known = contenders("regulators")
    assert {law.regulator.name for law in papers_laws()} | {find_default(), "late-braking"} <= set(style.LAW_COLOURS)
    words = {name: style.COLOURS[known[name].display.look.colour] for name in style.LAW_COLOURS}
    assert words == style.LAW_COLOURS


def test_all_other_laws_are_grey_and_so_are_the_papers_on_other_coordinates():
    others = set(contenders("regulators")) - set(style.LAW_COLOURS)
    assert len(others) >= 20
    assert {style.look(name).colour for name in others} == {style.REST}
    assert style.look("feedback-linearized/quaternion").colour == style.REST
    assert {style.look(name).colour for name in laws.TITLES} == set(list(style.LAW_COLOURS.values())[:3])
    assert style.look("rotation-matrix@geometric+solve").colour == style.LAW_COLOURS["rotation-matrix"]


def test_law_of_a_user_is_drawn_in_ink(monkeypatch):
    monkeypatch.setattr(laws, "is_users", lambda word: word == "my-law")
    assert style.look("my-law").colour == style.YOURS
    assert style.look("their-law").colour == style.REST


def test_no_other_file_writes_a_colour():
    written = [*REPORT.glob("figures/**/*.py"), *REPORT.glob("_extra/*.js")]
    assert len(written) > 50
    found = {path.name: HEX.findall(path.read_text(encoding="utf-8")) for path in written if path.name != "style.py"}
    assert {name: colours for name, colours in found.items() if colours} == {}


def test_no_style_sheet_writes_the_colour_of_a_law():
    of_laws = {colour for light in style.LAW_COLOURS.values() for colour in (light, style.TWINS[light])}
    sheets = [*REPORT.glob("_extra/*.css"), *REPORT.glob("_static/*.css"), *REPORT.glob("figures/**/*.html")]
    assert len(sheets) > 3
    for sheet in sheets:
        assert not of_laws & set(HEX.findall(sheet.read_text(encoding="utf-8").lower())), sheet.name


def test_no_preset_and_no_opening_of_the_live_page_shows_two_laws_in_one_colour():
    for one in (live.OPENING, *live.PRESETS.values()):
        assert style.look(one["a"]).colour != style.look(one["b"]).colour, one
