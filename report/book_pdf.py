"""Print the front page and the chapters of the built book as one PDF, which the front page then offers.

    make report ARGS=--pdf      needs chromium; without it the book has no PDF, and nothing else changes

The pages become one document: ids get the name of their page, links between chapters lead to places in
it, and links to other pages of the site become text, because a file on somebody's disk has no such page.
"""

import datetime
import re
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote, urlsplit

import screenshots
from lxml import etree, html

NAME = "orientation-bench.pdf"
WHOLE = "book-in-one.html"
PRINT_SECONDS = 300
LEFT_OUT = "//script | //iframe | //canvas | //*[@id='live-page'] | //button | //select | //dialog"
REFERRING = ("for", "aria-labelledby", "aria-describedby", "headers")
URL_OF_ID = re.compile(r"url\((['\"]?)#")
LINKED = "href", "src", "poster"
OFFER = re.compile(r'<span class="pdf">(.*?)</span>', re.DOTALL)
DATE = re.compile(rb"/(CreationDate|ModDate) \(D:[^)]*\)")
SWITCHES = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-pdf-header-footer"),
    "--generate-pdf-document-outline",
)


def list_pages(site: Path) -> list[Path]:
    """Return the pages of the PDF: the front page and the numbered chapters."""
    return [site / "index.html", *sorted(site.glob("pages/[0-9][0-9]-*.html"))]


def write_pdf(site: Path, epoch: str) -> str:
    """Write the PDF and offer it on the front page; return what was done, or why nothing was."""
    target = site / NAME
    if target.is_file():
        return f"{NAME} is there"
    program = screenshots.chromium()
    if not program:
        return f"no {NAME}: chromium is not on this machine (cure: {screenshots.CURE})"
    whole = site / WHOLE
    whole.write_bytes(join_pages(site))
    try:
        with tempfile.TemporaryDirectory() as profile:
            where = (f"--user-data-dir={profile}", f"--print-to-pdf={target}", whole.as_uri())
            subprocess.run([program, *SWITCHES, *where], capture_output=True, timeout=PRINT_SECONDS, check=True)
    except (subprocess.SubprocessError, OSError) as reason:
        target.unlink(missing_ok=True)
        return f"no {NAME}: {program} did not print it ({reason})"
    finally:
        whole.unlink()
    target.write_bytes(date_pdf(target.read_bytes(), int(epoch)))
    offer_pdf(site / "index.html")
    return f"{NAME}, {target.stat().st_size / 1e6:.1f} MB"


def offer_pdf(front: Path) -> None:
    """Turn the words for the PDF on the front page, which nobody sees without it, into a link."""
    page = front.read_text(encoding="utf-8")
    front.write_text(OFFER.sub(rf'<a class="pdf" href="{NAME}">\1</a>', page), encoding="utf-8")


def date_pdf(data: bytes, epoch: int) -> bytes:
    """Return the file with the date of the pages in place of the clock's, so that equal pages give equal bytes."""
    date = datetime.datetime.fromtimestamp(epoch, tz=datetime.UTC).strftime("%Y%m%d%H%M%S")
    return DATE.sub(lambda found: b"/%b (D:%b+00'00')" % (found[1], date.encode()), data)


def join_pages(site: Path) -> bytes:
    """Return the pages as one document that loads the front page's styles."""
    paths = list_pages(site)
    parser = html.HTMLParser(encoding="utf-8", huge_tree=True)
    book = html.document_fromstring((site / "index.html").read_bytes(), parser)
    book.set("data-theme", "light")
    names = {path.resolve(): path.stem for path in paths}
    articles = []
    for path in paths:
        page = html.document_fromstring(path.read_bytes(), parser)
        [article] = page.xpath("//article")
        clean_article(article)
        point_inside(article, path, names)
        rename_ids(article, path.stem)
        article.set("id", path.stem)
        articles.append(article)
    for script in book.xpath("//script"):
        script.drop_tree()
    body = book.find("body")
    body.clear()
    container = body
    for name in ("bd-main", "bd-content", "bd-article-container"):
        container = etree.SubElement(container, "div", {"class": name})
    container.extend(articles)
    return etree.tostring(book, method="html", encoding="utf-8", doctype="<!DOCTYPE html>")


def clean_article(article: html.HtmlElement) -> None:
    """Leave out what answers to a mouse or runs, show the pictures that stand for it, and load all at once."""
    for element in article.xpath(f".{LEFT_OUT.replace(' | //', ' | .//')}"):
        element.drop_tree()
    for element in article.xpath(".//noscript"):
        element.drop_tag()
    for film in article.xpath(".//video"):
        poster, words = film.get("poster"), film.get("aria-label", "")
        is_for_the_dark = "only-dark" in film.get("class", "")
        if poster and not is_for_the_dark:
            film.addprevious(etree.Element("img", {"src": poster, "alt": words}))
        film.drop_tree()
    for element in article.xpath(".//*[@loading]"):
        del element.attrib["loading"]


def point_inside(article: html.HtmlElement, path: Path, names: dict[Path, str]) -> None:
    """Make links to chapters lead to places of the book, and other addresses hold from the site's root."""
    for element, attribute, address in list_addresses(article):
        parts = urlsplit(address)
        if parts.scheme or not (parts.path or parts.fragment):
            continue
        target = (path.parent / unquote(parts.path)).resolve() if parts.path else path.resolve()
        if attribute != "href":
            element.set(attribute, target.relative_to(names_root(names)).as_posix())
        elif target in names:
            place = unquote(parts.fragment)
            is_place = place and "=" not in place  # with "=" it is the state of a page whose script reads it
            element.set("href", f"#{names[target]}--{place}" if is_place else f"#{names[target]}")
        elif element.tag == "a":
            del element.attrib["href"]


def names_root(names: dict[Path, str]) -> Path:
    """Return the folder of the front page, the site's root."""
    return next(path.parent for path, name in names.items() if name == "index")


def list_addresses(article: html.HtmlElement) -> Iterator[tuple[html.HtmlElement, str, str]]:
    """Yield (element, attribute, address) of what an article loads and links to."""
    for attribute in LINKED:
        for element in article.xpath(f".//*[@{attribute}]"):
            if not element.xpath("ancestor-or-self::svg"):
                yield element, attribute, element.get(attribute)


def rename_ids(article: html.HtmlElement, page: str) -> None:
    """Put the page's name before each id and before each reference to one, but for links, which have it."""
    for element in article.iter():
        if not isinstance(element.tag, str):
            continue
        for name, value in element.attrib.items():
            if name == "id":
                element.set(name, f"{page}--{value}")
            elif name in REFERRING:
                element.set(name, " ".join(f"{page}--{one}" for one in value.split()))
            elif name.endswith("href") and value.startswith("#") and element.tag != "a":
                element.set(name, f"#{page}--{value[1:]}")
            elif "url(" in value:
                element.set(name, URL_OF_ID.sub(rf"url(\1#{page}--", value))
