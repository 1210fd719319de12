"""Words of a figure are text in the page's own font: found, selected, and as wide as matplotlib measured them."""

import re

import pytest
import screenshots
from matplotlib import rc_context

from bench.base.provenance import ROOT
from report.figures.kit import inline, style
from report.figures.kit.inline import responsive_picture

WORDS = (
    "settling time [s]",
    "Since 1988: with memory",
    "39 of 1\u202f726 difficult starts",
    "“stable … but had varying settling times”",
    "−0.25 ≤ β < 90°, γ = 10⁻⁴",
    "Official <AVATAR> & Tower",
)
FONT = ROOT / "report" / "_static" / "fonts" / "orientation-sans.woff2"
PAGE = """<!doctype html><meta charset="utf-8"><html data-theme="light"><style>
@font-face {{ font-family: "Orientation Sans"; src: url("{font}") format("woff2"); font-weight: 400 700; }}
</style>{svg}"""


@responsive_picture
def many_words(narrow):
    figure, axes = style.panels(height=4.0, narrow=narrow)
    axes.axis("off")
    for place, words in enumerate(WORDS):
        axes.text(0.0, 0.9 - 0.15 * place, words, fontsize=10.5)
        axes.text(1.0, 0.9 - 0.15 * place, words, fontsize=8.5, fontweight="bold", ha="right")
    return figure, "Many words"


@responsive_picture
def mathematics(narrow):
    figure, axes = style.panels(height=2.0, narrow=narrow)
    axes.set_xlabel(r"$\alpha$ of the hand")
    axes.set_ylabel("angle [deg]")
    return figure, "A letter of a formula"


def texts_of(svg):
    return re.findall(r"<text[^>]*>([^<]*)</text>", svg)


def test_words_are_text_with_their_narrow_spaces_and_say_their_font_once():
    svg = many_words().wide
    escaped = [words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;") for words in WORDS]
    assert sorted(texts_of(svg)) == sorted(escaped * 2)
    assert svg.count("Orientation Sans") == 1  # the root says it
    assert "<defs" not in svg


def test_mathematics_is_drawn_as_outlines():
    svg = mathematics().wide
    assert "angle [deg]" in texts_of(svg)
    assert not any("alpha" in words or "hand" in words for words in texts_of(svg))
    assert 'xlink:href="#mathematics-' in svg


@pytest.mark.browser
@pytest.mark.skipif(bool(screenshots.missing(ROOT / "README.md")), reason="no browser")
def test_words_are_as_wide_in_a_browser_as_matplotlib_measured_them(opened, tmp_path):
    page = tmp_path / "page.html"
    page.write_text(PAGE.format(font=FONT.as_uri(), svg=many_words().wide), encoding="utf-8")
    screenshots.open_page(opened, page, screenshots.VIEWS[0])
    seen = opened.execute_script(
        "return [...document.querySelectorAll('text')].map(text => [text.textContent, text.getComputedTextLength()])"
    )
    with rc_context(fname=style.PAPER_STYLE):
        figure, _ = many_words.__wrapped__(narrow=False)
        inline.lay_out(figure)
        figure.draw_without_rendering()
        texts = [text for text in figure.axes[0].texts if text.get_text()]
        measured = [(text.get_text(), text.get_window_extent().width) for text in texts]
    assert len(seen) == len(measured) == 2 * len(WORDS)
    for (words, width), (same, expected) in zip(sorted(seen), sorted(measured), strict=True):
        assert words == same
        assert width == pytest.approx(expected, rel=0.01)
