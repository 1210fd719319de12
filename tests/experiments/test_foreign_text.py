"""Text that a law or a results file controls: on a page it reads as it is, and nothing of it is live."""

import html as markup
import json

import pytest
from bs4 import BeautifulSoup
from docutils.core import publish_string
from myst_parser.parsers.docutils_ import Parser

from bench.experiments.tables.run import shown_run
from bench.experiments.tables.schema import RESULTS
from bench.law.contenders.registry import contenders_of
from bench.law.kinds import Law
from report.figures.cards import regulators
from report.figures.kit import html
from report.figures.method import provenance as origin

ENABLED = ["amsmath", "attrs_block", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
PAYLOADS = (
    "<script>alert(1)</script>",
    "<img src=x onerror=alert(1)>",
    "```{raw} html\n<b>x</b>\n```",
    "{raw}`html`",
    "{eval-rst}`x`",
    ":::{note}\nx\n:::",
    "$x^2$ and $$y$$ and \\(z\\) and \\[w\\]",
    "a | b | c",
    "**bold** _it_ `code` ~~no~~",
    "[a](javascript:alert(1)) <javascript:alert(1)> ![x](y)",
    "&lt;b&gt; &amp; &#60;",
    "{{ substitution }} [x]{.class} (target)=",
    "\\begin{equation}x\\end{equation}",
    "# head\n\n- item",
    "%comment",
    "'\" onclick='x'",
)


def parsed(text: str) -> BeautifulSoup:
    return BeautifulSoup(text, "html.parser")


def rendered(markdown: str) -> BeautifulSoup:
    """Markdown as the report's pages read it, as HTML."""
    settings = {"myst_enable_extensions": ENABLED, "report_level": 1, "halt_level": 2, "raw_enabled": True}
    page = publish_string(markdown, parser=Parser(), writer_name="html5", settings_overrides=settings).decode()
    return parsed(page[page.index("<main") : page.index("</main>")])


def elements(page: BeautifulSoup) -> list[tuple[str, tuple]]:
    """Every element and the names of its attributes."""
    return [(one.name, tuple(one.attrs)) for one in page.find_all(True)]


def live(page: BeautifulSoup) -> list[tuple[str, tuple]]:
    """Its elements without those that only say where a line may break, of which a longer text has more."""
    return [one for one in elements(page) if one not in (("wbr", ()), ("span", ("class",)))]


def as_read(text: str) -> str:
    """What a reader sees: white space as one space."""
    return " ".join(text.split())


@pytest.mark.parametrize("text", PAYLOADS)
def test_foreign_text_in_a_table_reads_as_it_is_and_nothing_is_live(text):
    table = html.PageTable("Law | B")([(html.law("x", text), html.escape_untrusted(text))])
    plain = html.PageTable("Law | B")([(html.law("x", "word"), "word")])
    page = rendered(table)
    assert elements(page) == elements(rendered(plain))
    assert as_read(page.get_text()).count(as_read(text)) == 2


def nasty(text: str) -> Law:
    """One of our laws under another's words."""
    [mrp] = [one for one in regulators.in_order() if one.name == "mrp"]
    return mrp._replace(title=text, source=text, property=text)


@pytest.mark.parametrize("text", PAYLOADS)
def test_card_of_a_law_shows_its_words_and_takes_none_for_its_own(text):
    regulator = nasty(text)
    shown, usual = (
        parsed(regulators.card(contenders_of(one)[0], shown_run())) for one in (regulator, nasty("word"))
    )
    assert elements(shown) == elements(usual)
    assert as_read(text) in as_read(shown.get_text())


def test_formula_ends_only_where_it_ends():
    found = parsed(html.formula("x \\] </span><script>alert(1)</script>"))
    assert found.find("script") is None
    assert "<script>alert(1)</script>" in found.text


@pytest.mark.parametrize("text", PAYLOADS)
def test_provenance_from_elsewhere_is_shown_as_it_is(text):
    usual = json.loads((RESULTS / "reference" / "provenance.json").read_text())
    names = ("suite", "command", "cpu", "platform", "commit", "sources", "plan", "finished", "lock")
    versions = dict.fromkeys(usual["versions"], text)
    pages = []
    for said in (usual | dict.fromkeys(names, "word"), usual | dict.fromkeys(names, text) | {"versions": versions}):
        pages.append(rendered(origin.describe_run(said)))
    word, given = pages
    assert live(given) == live(word)
    assert as_read(markup.unescape(text)) in as_read(given.get_text()) or as_read(text) in as_read(given.get_text())
