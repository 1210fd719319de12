"""The page check: what is wrong with a built report, without a browser.

    python report/check_site.py [FOLDER]

A page must load nothing from the network, have no dead local link or anchor, describe every picture in
words, hold one main heading, no repeated id and no directive as text; the site must stay within its size budget.
"""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SITE = Path(__file__).resolve().parent / "_build" / "html"
# The theme is 3 MB, pages and figures 16 MB, the data of a default run 16 MB; a fifth to spare.
BUDGET_BYTES = 45_000_000
FRONT_BYTES = 1_500_000  # the front page with all that it loads
GENERATED = {"genindex.html", "search.html"}  # the theme's own pages: checked for loads, not for headings
LOADING_LINKS = {"stylesheet", "icon", "preload", "prefetch", "modulepreload", "preconnect", "dns-prefetch"}
FILE_NAME = re.compile(r"\S+\.(svg|png|jpe?g|webp|gif)$", re.IGNORECASE)
DIRECTIVE = re.compile(r"`{3,}\{[a-z:]+\}")
FONT = re.compile(r"""url\(\s*['"]?([^'")?#:]+\.woff2)""")
CSS_URL = re.compile(r"""url\(\s*['"]?((?:https?:)?//[^)'"\s]+)|@import\s+['"]((?:https?:)?//[^'"]+)""")


class Page(HTMLParser):
    """What a page loads, links to, names, and leaves undescribed."""

    def __init__(self) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.links: list[str] = []
        self.ids: list[str] = []
        self.headings = 0
        self.undescribed: list[str] = []
        self.described_in_figure = True
        self.unparsed: list[str] = []
        self.styles: list[str] = []
        self.in_style = False
        self.in_article = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        if given.get("id"):
            self.ids.append(given["id"])
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        if tag == "link" and LOADING_LINKS & set(given.get("rel", "").split()):
            self.loads.append(given.get("href", ""))
        if tag != "a":
            self.loads += [given[name] for name in ("src", "poster", "data") if given.get(name)]
        if "style" in given:
            self.styles.append(given["style"])
        self.in_article |= tag == "article"
        self.headings += tag == "h1" and self.in_article  # the theme repeats it outside, for print
        self.in_style = tag == "style"
        self.note_picture(tag, given)

    def note_picture(self, tag: str, given: dict[str, str]) -> None:
        """Note a picture: it says in words what it shows, and a figure holds at least one that does."""
        if tag == "figure":
            self.described_in_figure = False
        if tag == "img":
            words = given.get("alt", "").strip()
            if not words or FILE_NAME.match(words) or words.startswith("_images"):
                self.undescribed.append(f"image {given.get('src', '')[:60]} has no alternative text")
            self.described_in_figure = True
        is_drawing = tag == "svg" and given.get("role") == "img" and not given.get("aria-hidden")
        if tag in ("canvas", "video") or is_drawing:
            if not given.get("aria-label", "").strip():
                self.undescribed.append(f"{tag} {given.get('id', '')} has no aria-label")
            self.described_in_figure = True

    def handle_endtag(self, tag: str) -> None:
        if tag == "figure":
            if not self.described_in_figure:
                self.undescribed.append("figure without a described picture")
            self.described_in_figure = True
        if tag == "style":
            self.in_style = False
        if tag == "article":
            self.in_article = False

    def handle_data(self, data: str) -> None:
        if self.in_style:
            self.styles.append(data)
        elif self.in_article:
            self.unparsed += DIRECTIVE.findall(data)


def parsed(path: Path) -> Page:
    """One page, read."""
    page = Page()
    page.feed(path.read_text(encoding="utf-8"))
    return page


def problems(site: Path = SITE, budget_bytes: int = BUDGET_BYTES) -> list[str]:
    """Every problem of the site as one line each, empty when it is fit to publish."""
    if not (site / "index.html").is_file():
        return [f"{site} holds no index.html (cure: make report)"]
    pages = {path: parsed(path) for path in html_files(site)}
    found = [line for path, page in pages.items() for line in problems_of_page(path, page, pages, site)]
    for sheet in sorted(site.rglob("*.css")):
        text = sheet.read_text(encoding="utf-8", errors="replace")
        found += [f"{sheet.relative_to(site)}: loads {url}" for url in network_urls(text)]
    front = front_bytes(site, pages[site / "index.html"])
    if front > FRONT_BYTES:
        found.append(f"index.html loads {front / 1e6:.2f} MB, above its budget of {FRONT_BYTES / 1e6:.1f} MB")
    size = site_bytes(site)
    if size > budget_bytes:
        found.append(f"the site is {size / 1e6:.1f} MB, above its budget of {budget_bytes / 1e6:.0f} MB")
    return sorted(set(found))


def problems_of_page(path: Path, page: Page, pages: dict[Path, Page], site: Path) -> list[str]:
    """Return the problems of one page."""
    found = list(page.undescribed)
    found += [f"shows {start}, a directive taken for text (a backtick in its caption?)" for start in page.unparsed]
    found += [f"loads {url}" for style in page.styles for url in network_urls(style)]
    for url in dict.fromkeys(page.loads + page.links):
        parts = urlsplit(url)
        if parts.scheme in {"data", "mailto", "javascript"}:
            continue
        if parts.scheme or parts.netloc:
            if url in page.loads:
                found.append(f"loads {url} from the network")
            continue
        target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
        target = target / "index.html" if target.is_dir() else target
        if not target.exists():
            found.append(f"dead link {url}")
        elif parts.fragment and target in pages and url in page.links:
            anchor = unquote(parts.fragment)
            is_state = "=" in anchor  # of a page whose script reads it
            if anchor not in pages[target].ids and anchor not in {"", "top"} and not is_state:
                found.append(f"no anchor {url}")
    found += [f"id {name} appears twice" for name in {name for name in page.ids if page.ids.count(name) > 1}]
    if page.headings != 1 and path.name not in GENERATED:
        found.append(f"{page.headings} main headings instead of one")
    return [f"{path.relative_to(site)}: {line}" for line in found]


def network_urls(text: str) -> list[str]:
    """Addresses on the network that a style sheet would fetch."""
    return [first or second for first, second in CSS_URL.findall(text)]


def html_files(site: Path) -> list[Path]:
    """Return the pages of the site, the theme's templates left out."""
    return [path for path in sorted(site.rglob("*.html")) if "_static" not in path.relative_to(site).parts]


def site_bytes(site: Path) -> int:
    """Return what the site weighs."""
    return sum(path.stat().st_size for path in site.rglob("*") if path.is_file())


def front_bytes(site: Path, page: Page) -> int:
    """Return the weight of the front page, uncompressed: itself, what it loads, and the fonts of its style sheets."""
    loaded = {(site / unquote(urlsplit(url).path)).resolve() for url in page.loads}
    sheets = [path for path in loaded if path.suffix == ".css" and path.is_file()]
    fonts = {(one.parent / name).resolve() for one in sheets for name in FONT.findall(one.read_text(encoding="utf-8"))}
    return sum(path.stat().st_size for path in {site / "index.html", *loaded, *fonts} if path.is_file())


def summary(site: Path) -> str:
    """Pages and weight, in words."""
    return f"{len(html_files(site))} pages, {site_bytes(site) / 1e6:.1f} MB"


def main() -> int:
    """Print the problems; the exit code says whether there are any."""
    site = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else SITE
    found = problems(site)
    print("\n".join([*found, f"{summary(site)}, {len(found)} problems"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
