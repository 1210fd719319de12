"""The chapters as one PDF: links lead inside it, no address of this machine is in it, and the front page offers it."""

import book_pdf
import pytest
import screenshots
from lxml import html
from support import pdf

EPOCH = "1793491200"
FRONT = """<html><head><title>Book</title></head><body><article><h1>Book</h1>
<p><span class="pdf">All chapters as one PDF</span> <a href="pages/01-first.html#place">place</a>
<a href="pages/appendix.html">appendix</a> <a href="https://example.org/">out</a></p></article></body></html>"""
FIRST = """<html><body><article><h1 id="title">1. First</h1><p id="place"><a href="../index.html">back</a>
<a href="#title">up</a><a href="10-try-it.html#a=mrp">try</a></p><img src="../_static/a.png" alt="a">
<svg role="img" aria-label="b"><clipPath id="c"></clipPath><g clip-path="url(#c)"></g></svg>
<video data-film="x"></video>
<noscript><video class="light" poster="../_static/p.png" aria-label="film"></video></noscript>
<script>alert(1)</script></article></body></html>"""
SECOND = '<html><body><article><h1 id="title">10. Try</h1><p>{}</p></article></body></html>'


@pytest.fixture
def site(tmp_path):
    (tmp_path / "pages").mkdir()
    (tmp_path / "index.html").write_text(FRONT)
    (tmp_path / "pages" / "01-first.html").write_text(FIRST)
    (tmp_path / "pages" / "10-try-it.html").write_text(SECOND.format("words"))
    (tmp_path / "pages" / "appendix.html").write_text(SECOND.format("appendix"))
    return tmp_path


@pytest.fixture
def book(site):
    return html.document_fromstring(book_pdf.join_pages(site))


def test_links_lead_inside_the_book_and_words_stay_where_a_page_is_not_in_it(book):
    links = {link.text: link.get("href") for link in book.iter("a")}
    assert links == {
        "place": "#01-first--place",
        "appendix": None,
        "out": "https://example.org/",
        "back": "#index",
        "up": "#01-first--title",
        "try": "#10-try-it",
    }
    ids = set(book.xpath("//@id"))
    assert {link.removeprefix("#") for link in links.values() if link and link.startswith("#")} <= ids


def test_pages_of_the_book_share_no_id_and_each_reference_follows_its_own(book):
    ids = book.xpath("//@id")
    assert len(ids) == len(set(ids))
    assert book.xpath("//@clip-path") == ["url(#01-first--c)"]


def test_pictures_are_found_from_the_front_page_and_a_film_is_its_poster(book):
    assert book.xpath("//img/@src") == ["_static/a.png", "_static/p.png"]
    assert not book.xpath("//video | //script | //noscript")


def test_without_a_browser_there_is_no_pdf_and_the_front_page_offers_none(site, monkeypatch):
    monkeypatch.setenv("PATH", "")
    assert "chromium is not on this machine" in book_pdf.write_pdf(site, EPOCH)
    assert (site / "index.html").read_text() == FRONT
    assert not list(site.glob("*.pdf"))


def test_browser_that_fails_leaves_nothing_behind(site, tmp_path_factory, monkeypatch):
    program = tmp_path_factory.mktemp("bin") / "chromium"
    program.write_text("#!/bin/sh\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(program.parent), prepend=":")
    assert book_pdf.write_pdf(site, EPOCH).startswith(f"no {book_pdf.NAME}: {program} did not print it")
    assert sorted(path.name for path in site.iterdir()) == ["index.html", "pages"]


needs_chromium = pytest.mark.skipif(not screenshots.chromium(), reason=f"no chromium (cure: {screenshots.CURE})")


@pytest.mark.browser
@needs_chromium
def test_equal_pages_give_an_equal_pdf_that_the_front_page_offers_and_that_names_no_file_of_this_machine(site):
    book_pdf.write_pdf(site, EPOCH)
    assert (
        '<a class="pdf" href="orientation-bench.pdf">All chapters as one PDF</a>' in (site / "index.html").read_text()
    )
    first = (site / book_pdf.NAME).read_bytes()
    assert str(site).encode() not in first
    (site / book_pdf.NAME).unlink()
    (site / "index.html").write_text(FRONT)
    book_pdf.write_pdf(site, EPOCH)
    assert (site / book_pdf.NAME).read_bytes() == first


@pytest.mark.browser
@needs_chromium
def test_half_empty_page_is_found(site):
    words = "<p>word</p>" * 12
    tall = '<div style="height: 80vh; break-inside: avoid; border: 1px solid">tall</div>'
    (site / "pages" / "10-try-it.html").write_text(SECOND.format(f"{words}{tall}<p>end</p>"))
    style = "<style>article { break-before: page } div { height: 24cm !important }</style>"
    (site / "index.html").write_text(FRONT.replace("</head>", f"{style}</head>"))
    book_pdf.write_pdf(site, EPOCH)
    gaps = [page.largest_gap() for page in pdf.read_pages((site / book_pdf.NAME).read_bytes())]
    assert len(gaps) == 4
    assert gaps[2] > 0.4 > gaps[3]
