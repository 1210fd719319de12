"""The map of advice: cells of the nearest situations, letters, one key; drawn in print, alive with a script."""

import html
import json
import string

import numpy as np
import pytest
import screenshots
from matplotlib.path import Path as Outline
from support.pages import assert_is_drawn

from bench.base.provenance import ROOT
from bench.findings.selection.regions import find_default
from report.figures.answer import advice_map
from report.figures.kit import families, style
from tasks.situation import COORDINATES

STATIC, EXTRA = ROOT / "report" / "_static", ROOT / "report" / "_extra"
PAGE = """<!doctype html><html data-theme="light"><meta charset="utf-8"><link rel="stylesheet" href="{css}">
<body><article class="bd-article"><figure>{map}</figure></article>{script}</body></html>"""
SCRIPT = f'<script src="{(EXTRA / "advice.js").as_uri()}"></script>'


@pytest.fixture(scope="module")
def facts():
    return advice_map.facts(None)


@pytest.fixture(scope="module")
def data(facts):
    return json.loads(facts["map"].data)


@pytest.fixture(scope="module")
def points():
    return advice_map.list_points(advice_map.FIRST_PLANE, advice_map.FIRST_RULE)


@pytest.fixture
def show(opened, facts, tmp_path):
    def shown(script="", media="screen"):
        page = tmp_path / "page.html"
        css = (STATIC / "report.css").as_uri()
        page.write_text(PAGE.format(css=css, map=facts["map"]._repr_html_(), script=script), encoding="utf-8")
        screenshots.open_page(opened, page, screenshots.VIEWS[0])
        screenshots.look(opened, screenshots.VIEWS[0], media)
        return opened

    return shown


def is_seen(driver, selector):
    return driver.execute_script(f"return document.querySelector('{selector}').checkVisibility()")


def find_view_without_a_law(data):
    """Return the first plane and rule that the page offers with a situation in which no law is advised."""
    for plane, content in data["planes"].items():
        for number, rule in enumerate(data["rules"]):
            if any(point["verdicts"][number][0] < 0 for point in content["points"]):
                return plane, rule
    raise AssertionError("some law is advised in every situation of every view")


def list_words_of_view(data, plane, rule):
    """Return what the key of a view must have: each law that is advised there, and the words of none."""
    number = data["rules"].index(rule)
    laws = {point["verdicts"][number][0] for point in data["planes"][plane]["points"]}
    return {data["laws"][law]["name"] if law >= 0 else data["none"] for law in laws}


def test_drawing_is_whole_and_says_its_numbers(facts):
    assert_is_drawn(facts["map"].picture)
    assert facts["finding"] in facts["map"].alt


def test_cells_fill_the_plane_and_each_place_is_in_the_cell_of_the_nearest_situation(points):
    name = advice_map.FIRST_PLANE
    weights, top = np.array(advice_map.weights_of(name)), advice_map.top_of(name)
    cells = [Outline(cell) for cell in advice_map.find_cells(points, tuple(weights), top).corners]
    places = np.array([(point.x, point.y) for point in points])
    for place in np.random.default_rng(3).uniform((0.0, 0.0), (1.0, top), (200, 2)):
        away = np.linalg.norm((places - place) * weights, axis=1)
        inside = [number for number, cell in enumerate(cells) if cell.contains_point(place)]
        assert int(np.argmin(away)) in inside
        assert len(inside) == 1


def test_every_law_of_a_view_has_its_own_letter_inside_the_plane(data):
    letters = {law["name"]: law["letter"] for law in data["laws"] if law["letter"]}
    assert len(set(letters.values())) == len(letters)
    assert set(letters.values()) == set(string.ascii_uppercase[: len(letters)])
    for plane in data["planes"].values():
        for number, placed in enumerate(plane["letters"]):
            advised = {point["verdicts"][number][0] for point in plane["points"]} - {-1}
            assert {law for law, _, _ in placed} == advised
            assert all(data["laws"][law]["letter"] for law in advised)
            assert all(0.0 < x < 1.0 and 0.0 < y < plane["top"] for _, x, y in placed)


def test_laws_have_the_colours_of_every_figure(data):
    colours = {law["name"]: law["colour"][0] for law in data["laws"]}
    assert colours[families.word(find_default())] == style.LAW_COLOURS[find_default()]
    assert colours["hybrid"] == style.LAW_COLOURS["hybrid"]
    assert colours["rotation vector with memory"] == style.REST


def test_key_of_the_drawing_has_each_law_and_the_places_without_one(facts, points):
    svg = html.unescape(facts["map"].picture.wide)
    assert COORDINATES[advice_map.FIRST_PLANE].title in svg
    for law in {point.law for point in points}:
        assert (f": {families.word(law)}<" in svg) if law else (advice_map.NONE in svg)


def test_key_of_a_drawing_says_that_no_law_meets_the_requirements_exactly_where_that_is_so():
    views = [advice_map.list_points(advice_map.FIRST_PLANE, rule) for rule in advice_map.SHOWN]
    is_bare = [any(point.law is None for point in view) for view in views]
    assert set(is_bare) == {False, True}
    for view, expected in zip(views, is_bare, strict=True):
        drawing = advice_map.draw_plane(view, advice_map.letters_of(advice_map.advised_laws()))
        assert (f">{advice_map.NONE}<" in html.unescape(drawing.wide)) == expected


@pytest.mark.browser
@pytest.mark.skipif(bool(screenshots.missing(ROOT / "README.md")), reason="no browser")
def test_without_a_script_the_drawing_stands_alone(show):
    driver = show()
    assert is_seen(driver, ".advice-drawn svg")
    assert not any(is_seen(driver, one) for one in (".advice-choices", "#advice-map", "#advice-keys"))


@pytest.mark.browser
@pytest.mark.skipif(bool(screenshots.missing(ROOT / "README.md")), reason="no browser")
def test_with_a_script_keys_read_situations_and_print_has_the_drawing(show, data):
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select

    driver = show(SCRIPT)
    assert is_seen(driver, "#advice-map")
    assert not is_seen(driver, ".advice-drawn")
    canvas = driver.find_element("id", "advice-map")
    assert canvas.get_attribute("role") == "application"
    canvas.send_keys(Keys.ARROW_LEFT)
    said = driver.find_element("id", "advice-said").text
    assert said.startswith("zeta ")
    assert "99 % settle in" in said or advice_map.NONE in said
    assert "MRP with memory" in driver.find_element("id", "advice-keys").text
    assert screenshots.console_errors(driver) == []
    plane, rule = find_view_without_a_law(data)
    Select(driver.find_element("id", "advice-plane")).select_by_value(plane)
    Select(driver.find_element("id", "advice-rule")).select_by_value(rule)
    texts = [key.text for key in driver.find_elements("css selector", "#advice-keys > span")]
    words = list_words_of_view(data, plane, rule)
    assert advice_map.NONE in words
    assert len(texts) == len(words)
    assert all(any(text.endswith(word) for text in texts) for word in words)
    assert screenshots.console_errors(driver) == []
    driver = show(SCRIPT, media="print")
    assert is_seen(driver, ".advice-drawn")
    assert not is_seen(driver, "#advice-map")
