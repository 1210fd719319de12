"""Sphinx extension: what a search engine and a shared link show of a page, its lead and the book's picture."""

import html
import re
from typing import Any

LEAD = re.compile(r'<div class="lead[^>]*>(.*?)</div>', re.DOTALL)
FEWEST, MOST = 40, 200
PICTURE = "_static/media/fates.png"


def add_tags(app: Any, pagename: str, templatename: str, context: dict[str, Any], doctree: Any) -> None:
    """Give a page its description and its picture."""
    found = LEAD.search(context.get("body", ""))
    lead = " ".join(html.unescape(re.sub(r"<[^>]+>", "", found[1])).split()) if found else ""
    text = lead if len(lead) > FEWEST else app.config.html_title
    if len(text) > MOST:
        text = f"{text[:MOST].rpartition(' ')[0]} …"
    title = html.unescape(re.sub(r"<[^>]+>", "", context.get("title", "")))
    tags = {"og:type": "article", "og:title": title, "og:description": text}
    tags["og:image"] = app.config.html_baseurl + PICTURE if app.config.html_baseurl else context["pathto"](PICTURE, 1)
    lines = [f'<meta name="description" content="{html.escape(text)}">']
    lines += [f'<meta property="{name}" content="{html.escape(value)}">' for name, value in tags.items()]
    lines.append('<meta name="twitter:card" content="summary_large_image">')
    context["metatags"] = context.get("metatags", "") + "\n".join(lines)


def setup(app: Any) -> dict[str, bool]:
    app.connect("html-page-context", add_tags)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
