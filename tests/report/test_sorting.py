"""Tables that sort compare numbers as numbers, powers of ten and thin spaces included."""

import pytest
import screenshots

from bench.base.provenance import ROOT

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(bool(screenshots.missing(ROOT / "README.md")), reason="no browser"),
]
CELLS = ("2·10⁵", "0.004", "9.9·10⁻⁵", "never", "12\u202f000", "10⁶", "\u22123")
IN_ORDER = ("\u22123", "9.9·10⁻⁵", "0.004", "12\u202f000", "2·10⁵", "10⁶", "never")
PAGE = """<!doctype html><meta charset="utf-8"><table class="sortable"><thead><tr><th>Peak</th></tr></thead>
<tbody>{rows}</tbody></table><script src="{script}"></script>"""


def test_column_of_powers_is_sorted_by_value(opened, tmp_path):
    page = tmp_path / "page.html"
    rows = "".join(f"<tr><td>{cell}</td></tr>" for cell in CELLS)
    script = (ROOT / "report" / "_extra" / "sortable.js").as_uri()
    page.write_text(PAGE.format(rows=rows, script=script), encoding="utf-8")
    screenshots.open_page(opened, page, screenshots.VIEWS[0])
    opened.find_element("css selector", "table.sortable th button").click()
    cells = opened.execute_script("return [...document.querySelectorAll('td')].map(cell => cell.innerText)")
    assert tuple(cells) == IN_ORDER
