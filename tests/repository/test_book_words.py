"""How much a reader of the book is asked to read: its text, without code and displayed formulas."""

import re

import pytest

from bench.provenance import ROOT

MOST = 15_000
PAGES = [ROOT / "report/index.md", *sorted((ROOT / "report/pages").glob("*.md"))]
NOT_TEXT = (
    re.compile(r"\A---.*?---\n", re.DOTALL),
    re.compile(r"^```(?:\{code-cell\}[^\n]*|\{eval-rst\}|bash|yaml|python|sh|c)\n.*?^```$", re.DOTALL | re.MULTILINE),
    re.compile(r"\$\$.*?\$\$", re.DOTALL),
    re.compile(r"^(?:`{3,}|:{3,}).*$", re.MULTILINE),
    re.compile(r"^:\w+:.*$", re.MULTILINE),
)
CAPTION = re.compile(r"^`{3,}\{table\} (.*)$", re.MULTILINE)
ABOUT_THE_TOOL = ("31-", "32-", "33-", "34-", "35-", "36-")
GLUED = re.compile(r"\{glue:\w+\}`[^`]*`")


def words(page: str, captions: bool = False) -> int:
    """Words of a page's text; a computed number or name is one. captions: of tables too; those of figures always."""
    if captions:
        page = CAPTION.sub(r"\1", page)
    for each in NOT_TEXT:
        page = each.sub("", page)
    return len(GLUED.sub("X", page).split())


@pytest.mark.parametrize(
    ("page", "count"),
    [
        ("---\nkernelspec: x\n---\n\n# A title\n\nTwo {glue:text}`a b c`.\n", 5),
        ("```{code-cell} python\nfrom a import b\n```\n\nText.\n\n$$ a = b $$\n", 1),
        ("````{table} A caption.\n:name: tab-a\n\n```{glue:md} x\n:format: myst\n```\n````\n\n```bash\nls\n```\n", 0),
    ],
)
def test_words_are_those_that_a_reader_reads(page, count):
    assert words(page) == count


def test_book_is_short_enough():
    counts = {page.name: words(page.read_text(encoding="utf-8")) for page in PAGES}
    assert 0 < sum(counts.values()) <= MOST, counts


def test_chapters_and_appendices_are_short_enough_with_every_caption():
    book = [page for page in PAGES if not page.name.startswith(ABOUT_THE_TOOL)]
    counts = {page.name: words(page.read_text(encoding="utf-8"), captions=True) for page in book}
    assert 0 < sum(counts.values()) <= MOST, sum(counts.values())
