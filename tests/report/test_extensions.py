"""The book's extensions: descriptions, the theme's faults, and the page of the balls."""

import ball_pages
import pytest
import sharing
import theme_faults

THEMED = """<head><meta name="viewport" content="a" /><meta name="viewport" content="b" />
<meta name="viewport" content="c"/></head><body><dialog id="pst-primary-sidebar-modal"></dialog>
<div id="pst-primary-sidebar"><div class="sidebar-primary-item">
<a class="navbar-brand logo" href="#"></a></div>
<button class="btn search-button-field pst-js-only" title="Search" aria-label="Search">Search <kbd>Ctrl</kbd></button>
<i class="theme-switch fa-solid" data-mode="light" title="Light"></i></div></body>"""


def test_faults_of_the_theme_are_mended():
    page = theme_faults.mend(THEMED)
    assert page.count("viewport") == 1
    assert '<dialog id="pst-primary-sidebar-modal" aria-label="Menu">' in page
    assert 'role="navigation" aria-label="Front page"' in page
    assert 'aria-label="Search">Search' not in page
    assert 'title="Light"' not in page


def test_theme_of_another_form_is_an_error():
    with pytest.raises(ValueError, match="the theme has another form"):
        theme_faults.mend(THEMED.replace("search-button-field", "search-field"))


def test_description_is_the_lead_and_is_cut_at_a_word():
    lead = "A sentence of a lead, with <strong>bold</strong> words &amp; signs. " * 5
    text = sharing.describe(f'<div class="lead docutils">{lead}</div>', "Title", "Book")
    assert text.startswith("A sentence of a lead, with bold words & signs. A")
    assert text.endswith(" …")
    assert len(text) <= sharing.MOST + 2


def test_description_of_a_law_has_its_title_its_source_and_what_it_does():
    card = '<span class="card-source">published: Murphy 1988</span><div class="card-text x"><p>What it does.</p></div>'
    assert sharing.describe(card, "A law", "Book") == "A law, published: Murphy 1988. What it does."


def test_page_without_a_lead_is_described_by_its_title():
    assert sharing.describe("<p>words</p>", "Search", "Book") == "Search. Book"


LIVE = """<html><head><link href="theme.css"></head><body><section id="live-page" hidden><p>controls</p></section>
<script type="application/json" id="live-data">{}</script><script id="live-laws">laws</script><section>text</section>
<script src="../live-space.js" defer></script><script src="../_static/theme.js"></script></body></html>"""


def test_page_of_the_ball_has_what_its_script_needs_and_nothing_of_the_theme():
    page = ball_pages.make_ball(LIVE)
    assert "<p>controls</p></section>" in page
    assert all(part in page for part in ('id="live-data">{}', 'id="live-laws">laws', "../live-space.js"))
    assert "theme" not in page


def test_live_page_without_its_data_is_an_error():
    with pytest.raises(ValueError, match="are missing"):
        ball_pages.make_ball(LIVE.replace("live-data", "data"))
