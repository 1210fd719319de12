"""Pages' cells are run before Sphinx reads them, and kept where it looks for them."""

import asyncio

import pytest

pytest.importorskip("jupyter_cache", reason="the report extra is not installed (cure: make setup)")
import cells
from jupyter_cache import get_cache

PAGE = """---
jupytext: {{text_representation: {{extension: .md, format_name: myst}}}}
kernelspec: {{name: python3, display_name: Python 3}}
---
# A page

```{{code-cell}} python
{cell}
```
"""


@pytest.fixture
def book(tmp_path, monkeypatch):
    """A book of three pages: one shows 42, one raises, one has no cells."""
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    (tmp_path / "pages").mkdir()
    (tmp_path / "index.md").write_text(PAGE.format(cell="6 * 7"))
    (tmp_path / "pages" / "raising.md").write_text(PAGE.format(cell="1 / 0"))
    (tmp_path / "pages" / "plain.md").write_text("# Words only\n")
    return tmp_path


def cache_of(book):
    return get_cache(book / cells.CONFIG["execute"]["cache"])


def test_outputs_are_kept_and_a_page_that_fails_is_left_to_sphinx(book):
    asyncio.run(cells.main(book))
    cache, pages = cache_of(book), {path.stem: page for path, page in cells.read_notebooks(book).items()}
    assert {name: cells.is_known(cache, page) for name, page in pages.items()} == {"index": True, "raising": False}
    _, shown = cache.merge_match_into_notebook(pages["index"])
    assert shown.cells[-1].outputs[0]["data"]["text/plain"] == "42"


def test_names_of_one_page_are_not_those_of_the_next(book):
    (book / "index.md").write_text(PAGE.format(cell="left = 1"))
    (book / "pages" / "raising.md").write_text(PAGE.format(cell="assert 'left' not in globals()"))
    cache, pages = cache_of(book), [book / "index.md", book / "pages" / "raising.md"]
    asyncio.run(cells.work([pages], cells.read_notebooks(book), cache))
    assert [cells.is_known(cache, page) for page in cells.read_notebooks(book).values()] == [True, True]
