"""Sphinx extension: every entry of a bibliography is an item of its list to a screen reader.

Docutils gives the list role="list" and its entries role="doc-biblioentry", which ARIA 1.3 deprecates and which no list
may hold.
"""

from __future__ import annotations

ENTRY, ITEM = 'role="doc-biblioentry"', 'role="listitem"'


def as_items(app, pagename: str, templatename: str, context: dict, doctree) -> None:
    """Return the page's body with its entries as items."""
    if "body" in context:
        context["body"] = context["body"].replace(ENTRY, ITEM)


def setup(app) -> dict:
    app.connect("html-page-context", as_items)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
