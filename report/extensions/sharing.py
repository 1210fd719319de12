"""Sphinx extension: what a search engine, a shared link and a browser's tab show of a page.

A page's description is its lead, and a law's is its title, its source and the first lines of its card.
The picture is the book's card. Its address is relative while the book has no public address
(html_baseurl): then a site that shows links cannot load it, and there is no canonical address.
"""

import html
import re
from pathlib import Path
from typing import Any

from PIL import Image

LEAD = re.compile(r'<div class="lead[^>]*>(.*?)</div>', re.DOTALL)
LAW_SOURCE = re.compile(r'<span class="card-source">(.*?)</span>', re.DOTALL)
LAW_TEXT = re.compile(r'<div class="card-text[^>]*>(.*?)</p>', re.DOTALL)
TAG = re.compile(r"<[^>]+>")
FEWEST, MOST = 40, 200
CARD, BEFORE_IT = "_static/media/card.png", "_static/media/fates.png"
"""The card, 1200 by 630 pixels, and the picture that is shown while there is none."""
ICONS = (
    '<link rel="icon" type="image/png" sizes="32x32" href="{small}">',
    '<link rel="apple-touch-icon" href="{large}">',
)
"""For browsers that draw no SVG in a tab."""


def plain(markup: str) -> str:
    """Return the words of a piece of HTML."""
    return " ".join(html.unescape(TAG.sub(" ", markup)).split()).replace(" .", ".").replace(" ,", ",")


def describe(body: str, title: str, book: str) -> str:
    """Return what a page is about, in at most MOST characters."""
    lead, source = LEAD.search(body), LAW_SOURCE.search(body)
    if source:
        text = LAW_TEXT.search(body)
        words = f"{title}, {plain(source[1])}. {plain(text[1]) if text else ''}".strip()
    else:
        words = plain(lead[1]) if lead else ""
    if len(words) <= FEWEST:
        words = f"{title}. {book}" if title else book
    return words if len(words) <= MOST else f"{words[:MOST].rpartition(' ')[0]} …"


def add_tags(app: Any, pagename: str, templatename: str, context: dict[str, Any], doctree: Any) -> None:
    """Give a page its description, its picture and its icons."""
    title = plain(context.get("title", ""))
    text = describe(context.get("body", ""), title, app.config.html_title)
    tags = {"og:type": "article", "og:title": title, "og:description": text, **describe_picture(app, context)}
    lines = [f'<meta name="description" content="{html.escape(text)}">']
    lines += [f'<meta property="{name}" content="{html.escape(value)}">' for name, value in tags.items()]
    lines.append('<meta name="twitter:card" content="summary_large_image">')
    small, large = (context["pathto"](f"_static/favicon-{size}.png", 1) for size in (32, 180))
    lines += [icon.format(small=small, large=large) for icon in ICONS]
    context["metatags"] = context.get("metatags", "") + "\n".join(lines)


def describe_picture(app: Any, context: dict[str, Any]) -> dict[str, str]:
    """Return the tags of the book's picture: its address and its size."""
    source = Path(app.srcdir)
    name = CARD if (source / CARD).is_file() else BEFORE_IT
    with Image.open(source / name) as picture:
        width, height = picture.size
    base = app.config.html_baseurl
    address = base + name if base else context["pathto"](name, 1)
    return {"og:image": address, "og:image:width": str(width), "og:image:height": str(height)}


def setup(app: Any) -> dict[str, bool]:
    app.connect("html-page-context", add_tags)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
