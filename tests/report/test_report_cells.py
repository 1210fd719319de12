"""Pages' cells are run before Sphinx reads them, and kept where it looks for them."""

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


def test_outputs_are_kept_and_a_page_that_fails_is_left_to_sphinx(book):
    cells.main(book)
    cache = get_cache(book / cells.CONFIG["execute"]["cache"])
    [record] = cache.list_cache_records()
    assert record.uri == str(book / "index.md")
    shown = cache.get_cache_bundle(record.pk).nb
    assert shown.cells[0].outputs[0]["data"]["text/plain"] == "42"
