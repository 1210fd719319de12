"""The page check: what is wrong with a built report, without a browser.

A page must load nothing from the network, have no dead local link or anchor, describe every picture in
words, hold one main heading, one viewport, a description of its own, no repeated id and no directive as
text; the site must stay within its size budget.
"""

import re
from collections import Counter
from pathlib import Path
from urllib.parse import unquote, urlsplit

from lxml import html

# The theme is 3 MB, pages and figures 16 MB, the data of a default run 16 MB; a fifth to spare.
BUDGET_BYTES = 45_000_000
FRONT_BYTES = 1_500_000  # the front page with all that it loads
GENERATED = {"genindex.html", "search.html"}  # the theme's own pages: checked for loads, not for headings
LOADING_LINKS = {"stylesheet", "icon", "preload", "prefetch", "modulepreload", "preconnect", "dns-prefetch"}
FILE_NAME = re.compile(r"_images.*|\S+\.(svg|png|jpe?g|webp|gif)$|$", re.IGNORECASE)
DIRECTIVE = re.compile(r"`{3,}\{[a-z:]+\}")
FONT = re.compile(r"""url\(\s*['"]?([^'")?#:]+\.woff2)""")
CSS_URL = re.compile(r"""(?:url\(\s*['"]?|@import\s+['"])((?:https?:)?//[^)'"\s]+)""")
DRAWINGS = ".//canvas | .//iframe | .//video | .//svg[@role='img'][not(@aria-hidden)]"


def find_problems(site: Path, budget_bytes: int = BUDGET_BYTES) -> list[str]:
    """Return every problem of the site as one line each, none when it is fit to publish."""
    if not (site / "index.html").is_file():
        return [f"{site} holds no index.html (cure: make report)"]
    parser = html.HTMLParser(encoding="utf-8", huge_tree=True)
    pages = {path: html.document_fromstring(path.read_bytes(), parser) for path in html_files(site)}
    ids = {path: Counter(page.xpath("//@id")) for path, page in pages.items()}
    found = [
        f"{path.relative_to(site)}: {line}"
        for path, page in pages.items()
        for line in (*describe_parts(path, page), *check_links(path, page, ids))
    ]
    found += find_shared_descriptions(site, pages)
    for sheet in site.rglob("*.css"):
        text = sheet.read_text(encoding="utf-8", errors="replace")
        found += [f"{sheet.relative_to(site)}: loads {url}" for url in CSS_URL.findall(text)]
    front, size = front_bytes(site, pages[site / "index.html"]), site_bytes(site)
    if front > FRONT_BYTES:
        found.append(f"index.html loads {front / 1e6:.2f} MB, above its budget of {FRONT_BYTES / 1e6:.1f} MB")
    if size > budget_bytes:
        found.append(f"the site is {size / 1e6:.1f} MB, above its budget of {budget_bytes / 1e6:.0f} MB")
    return sorted(set(found))


def describe_parts(path: Path, page: html.HtmlElement) -> list[str]:
    """Return what a page leaves undescribed, shows as text, or has too often."""
    images = [one for one in page.iter("img") if FILE_NAME.match((one.get("alt") or "").strip())]
    found = [f"image {(one.get('src') or '')[:60]} has no alternative text" for one in images]
    drawings = [one for one in page.xpath(DRAWINGS) if not (one.get("aria-label") or "").strip()]
    found += [f"{one.tag} {one.get('id') or ''} has no aria-label" for one in drawings]
    found += [
        "figure without a described picture" for one in page.iter("figure") if not one.xpath(f".//img | {DRAWINGS}")
    ]
    shown = [start for text in page.xpath("//article//text()") for start in DIRECTIVE.findall(text)]
    found += [f"shows {start}, a directive taken for text (a backtick in its caption?)" for start in shown]
    styles = page.xpath("//@style | //style/text()")
    found += [f"loads {url}" for style in styles for url in CSS_URL.findall(style)]
    found += [f"id {name} appears twice" for name, count in Counter(page.xpath("//@id")).items() if count > 1]
    viewports = len(page.xpath("//meta[@name='viewport']"))
    if viewports > 1:
        found.append(f"{viewports} viewports instead of one")
    headings = len(page.xpath("//article//h1"))  # the theme repeats it outside, for print
    if headings != 1 and path.name not in GENERATED:
        found.append(f"{headings} main headings instead of one")
    return found


def find_shared_descriptions(site: Path, pages: dict[Path, html.HtmlElement]) -> list[str]:
    """Return one line for each page that a search engine would describe as it describes an earlier one."""
    first: dict[str, Path] = {}
    found = []
    for path, page in pages.items():
        if path.name in GENERATED:
            continue
        for text in page.xpath("//meta[@name='description']/@content"):
            same = first.setdefault(text, path)
            if same != path:
                found.append(f"{path.relative_to(site)}: has the description of {same.relative_to(site)}")
    return found


def list_loads(page: html.HtmlElement) -> list[str]:
    """Return the addresses of all that a page loads."""
    linked = [
        one.get("href") for one in page.xpath("//link[@href]") if LOADING_LINKS & {*(one.get("rel") or "").split()}
    ]
    return [*linked, *page.xpath("//*[not(self::a)]/@*[name()='src' or name()='poster' or name()='data']")]


def check_links(path: Path, page: html.HtmlElement, ids: dict[Path, Counter[str]]) -> list[str]:
    """Return the dead links of a page, and what it loads from the network."""
    loads, links, found = list_loads(page), page.xpath("//a/@href"), []
    for url in dict.fromkeys([*loads, *links]):
        parts = urlsplit(url)
        if not url or parts.scheme in {"data", "mailto", "javascript"}:
            continue
        if parts.scheme or parts.netloc:
            found += [f"loads {url} from the network"] if url in loads else []
            continue
        target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
        target = target / "index.html" if target.is_dir() else target
        anchor = unquote(parts.fragment)
        if not target.exists():
            found.append(f"dead link {url}")
        elif target in ids and url in links and anchor not in {*ids[target], "", "top"} and "=" not in anchor:
            found.append(f"no anchor {url}")  # with "=" it is the state of a page whose script reads it
    return found


def html_files(site: Path) -> list[Path]:
    """Return the pages of the site, the theme's templates left out."""
    return [path for path in sorted(site.rglob("*.html")) if "_static" not in path.relative_to(site).parts]


def site_bytes(site: Path) -> int:
    """Return what the site weighs."""
    return sum(path.stat().st_size for path in site.rglob("*") if path.is_file())


def front_bytes(site: Path, page: html.HtmlElement) -> int:
    """Return the weight of the front page, uncompressed: itself, what it loads, and the fonts of its style sheets."""
    loaded = {(site / unquote(urlsplit(url).path)).resolve() for url in list_loads(page)}
    sheets = [path for path in loaded if path.suffix == ".css" and path.is_file()]
    fonts = {(one.parent / name).resolve() for one in sheets for name in FONT.findall(one.read_text(encoding="utf-8"))}
    return sum(path.stat().st_size for path in {site / "index.html", *loaded, *fonts} if path.is_file())


def summary(site: Path) -> str:
    """Return the number of pages and the weight, in words."""
    return f"{len(html_files(site))} pages, {site_bytes(site) / 1e6:.1f} MB"
