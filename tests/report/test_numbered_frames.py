"""Balls of the chapters are figures with a number and a label."""

import re

import pytest
from docutils import nodes
from docutils.frontend import get_default_settings
from docutils.parsers.rst import Parser
from docutils.utils import new_document
from numbered_frames import FIGURE, NumberFrames

from report.figures.kit.page import REPORT

BALL = """<figure class="ball-view">
<iframe src="ball.html#stuck" aria-label="Starts" loading="lazy"></iframe>
<figcaption>All starts on the <b>surface</b> are stuck.</figcaption>
</figure>"""
SITE = REPORT / "_build" / "html"


def numbered(text):
    document = new_document("page", get_default_settings(Parser))
    document += nodes.raw("", text, format="html")
    NumberFrames(document).apply()
    return document


def test_ball_becomes_a_figure_with_its_caption_and_its_label():
    document = numbered(BALL)
    [figure] = document.findall(nodes.figure)
    assert figure["classes"] == ["ball-view"]
    assert figure["ids"] == [document.nameids["fig-ball-stuck"]]
    frame, caption = figure.children
    assert frame.astext().startswith("<iframe")
    assert frame["format"] == "html"
    assert isinstance(caption, nodes.caption)
    assert caption.astext() == "All starts on the <b>surface</b> are stuck."


def test_other_html_stays():
    document = numbered("<figure><img></figure>")
    assert not list(document.findall(nodes.figure))


def test_ball_that_does_not_say_what_it_shows_is_refused():
    with pytest.raises(ValueError, match="does not say what it shows"):
        numbered(BALL.replace("#stuck", ""))


def test_every_ball_of_a_page_has_the_form_that_is_numbered():
    texts = [path.read_text(encoding="utf-8") for path in REPORT.glob("pages/*.md")]
    balls = sum(text.count('class="ball-view"') for text in texts)
    assert balls == sum(len(FIGURE.findall(text)) for text in texts) > 0


@pytest.mark.skipif(not (SITE / "index.html").is_file(), reason="the report is not built")
def test_every_ball_film_and_map_of_the_built_report_has_a_number():
    for page in SITE.glob("pages/*.html"):
        # The live page without a script has pictures of itself, under captions of their own, which nobody need cite.
        text = page.read_text(encoding="utf-8")
        for figure in re.findall(r"<figure.*?</figure>", text, re.DOTALL):
            if "/live-" in figure and "ball-view" not in figure:
                continue
            assert 'class="caption-number">Figure ' in figure, (page.name, figure[:200])
        if page.name != "ball.html":
            assert "<iframe" not in re.sub(r"<figure.*?</figure>", "", text, flags=re.DOTALL), page.name
