"""How figures and page parts are made: colours, ids, words, numbers."""

import re

import pandas as pd
import pytest

from bench.law.contenders.registry import contenders
from bench.law.display import COLOURS, LINES
from report.figures.kit import html, style
from report.figures.kit.html import PageTable
from report.figures.kit.inline import Picture, responsive_picture


@responsive_picture
def two_laws(narrow):
    figure, axes = style.panels(height=2.0, narrow=narrow)
    for name in ("rotation-matrix", "linearized-euler"):
        axes.plot([0, 1], [0, 1], color=style.look(name).colour, marker=style.look(name).marker)
    return figure, 'Two laws, "equal" & straight'


@responsive_picture
def undescribed(narrow):
    figure, _ = style.panels(height=2.0, narrow=narrow)
    return figure, " "


def test_every_look_has_a_dark_twin():
    looks = [style.look(name) for name in contenders("regulators")]
    assert {look.colour for look in looks} <= set(style.TWINS)


def test_look_of_every_law_and_of_all_coordinates_can_be_drawn():
    ours = (*contenders("regulators").values(), *contenders("representations").values())
    assert [one.name for one in ours if one.display.look and not one.display.look.is_known] == []
    assert list(style.COLOURS) == list(COLOURS)
    assert list(style.LINES) == list(LINES)


def test_unknown_law_has_a_look_of_its_own_that_stays():
    assert style.look("my-law") == style.look("my-law/quaternion")
    assert style.look("my-law").colour == style.REST
    assert style.look("my-law").marker in style.SPARE_MARKERS


def test_picture_names_its_colours_and_says_what_it_shows():
    svg = two_laws().wide
    assert 'role="img" aria-label="Two laws, &quot;equal&quot; &amp; straight"' in svg
    assert "--c064fa8: light-dark(#064fa8, #5a7cfd)" in svg
    assert "stroke: var(--c064fa8)" in svg
    assert "stroke: #064fa8" not in svg
    assert "<style" not in svg


def test_picture_keeps_only_ids_that_are_used_and_owns_them():
    svg = two_laws().wide
    ids = re.findall(r'\bid="([^"]+)"', svg)
    used = set(re.findall(r"url\(#([^)]+)\)", svg)) | set(re.findall(r'href="#([^"]+)"', svg))
    assert ids
    assert len(ids) == len(set(ids))
    assert set(ids) == used
    assert all(name.startswith("two-laws-") for name in ids)


def test_picture_without_words_is_refused():
    with pytest.raises(ValueError, match="undescribed has no alternative text"):
        undescribed()


def test_responsive_picture_is_drawn_for_a_phone_too():
    drawn = two_laws()
    assert isinstance(drawn, Picture)
    assert drawn.wide != drawn.narrow
    assert 'class="picture narrow"' in drawn._repr_html_()


def test_picture_is_the_same_bytes_every_time_and_leaves_the_style_of_others_alone():
    import matplotlib

    before = dict(matplotlib.rcParams)
    assert two_laws() == two_laws()
    assert dict(matplotlib.rcParams) == before


def test_table_writes_its_columns_in_their_order_with_their_formats_numbers_right_and_words_left():
    rows = PageTable(
        "Law | Settled [%]:.1f | Error | k | n | rest",
        {"Error": lambda value: f"<{value}>"},
        words=["k"],
    )
    row = {"rest": float("nan"), "n": 5000, "k": 1, "Error": 5, "Settled [%]": 12.34, "Law": "a|b"}
    assert rows(pd.DataFrame([row])).splitlines() == [
        "| Law | Settled [%] | Error | k | n | rest |",
        "| :-- | --: | --: | :-- | --: | --: |",
        "| a\\|b | 12.3 | <5> | 1 | 5000 | – |",
    ]
    assert rows([tuple(row.values())[::-1]]) == rows(pd.DataFrame([row]))


def test_table_refuses_a_format_for_no_column():
    with pytest.raises(ValueError, match=r"\['m'\], not columns of the table; known: \['n'\]"):
        PageTable("n", {"m": str})


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (7.0, "7"),
        (1234.5, "1234"),
        (12345.0, "12\u202f345"),
        (-0.14286, "\u22120.143"),
        (2.5e12, "2.5·10¹²"),
        (9.9e-5, "9.9·10⁻⁵"),
        (-4.12e-4, "\u22124.1·10⁻⁴"),
        (0.00412, "0.00412"),
        (None, "–"),
        ("e-5", "e-5"),
        (True, "True"),
    ],
)
def test_cell_reads_like_print(value, text):
    assert html.cell(value) == text


def test_badge_refuses_a_word_that_is_no_verdict():
    with pytest.raises(ValueError, match="'true' is none of ours; known: holds"):
        html.badge("true")


def test_labels_beside_curves_do_not_touch_and_keep_their_order():
    assert style.apart([30.0, 0.0, 10.0], 5.0) == [30.0, 0.0, 10.0]
    moved = style.apart([-80.0, 4.0, 0.0], 10.0)
    assert moved == pytest.approx([-80.0, 7.0, -3.0])
