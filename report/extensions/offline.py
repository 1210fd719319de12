"""Sphinx extension: pages that need nothing from the network, without what no reader loads.

Thebe, which jupyter-book switches on and which would run cells on a server, is taken out, and so are source maps,
translations, and the theme's icons but for those that a page shows: it ships two thousand, twice, as a script that
draws them, 1.5 MB on every page, and as fonts for the moment before that script has run. An entry of the bibliography
is an item of its list to a screen reader: docutils gives it role="doc-biblioentry", which ARIA 1.3 deprecates.
"""

import re
import shutil
from pathlib import Path
from typing import Any

AFTER_ALL_OTHERS = 999
UNREAD = ("**/*.map", "sphinx-thebe.*", "fonts/*.md", "locales/**/*.[mp]o")
DRAWN = Path("scripts") / "fontawesome.js"
STYLE = Path("styles") / "pydata-sphinx-theme.css"
# "name":[width,height,["alias", ...],"code point",path or paths],
ICON = re.compile(r'(?:"([\w-]+)"|\b(\w+)):\[\d+,\d+,\[([^\]]*)\],"[0-9a-f]+",(?:"[^"]*"|\[[^\]]*\])\],?')
# .fa-name:before,.fa-alias:before{content:"..."}
RULE = re.compile(r'(?:\.fa-[\w-]+:before,?)+\{content:"[^"]*"\}')
SEARCH = Path("searchtools.js")
PATCHES = (
    (re.compile(r"\s*\|\|\s*queryTerm\.match\(/\^\\d\+\$/\)"), ""),  # a number is a word: 180
    (re.compile(r"(?=fetch\(requestUrl\))"), 'if (location.protocol !== "file:") '),  # no excerpts without a server
)
FACE = re.compile(r"@font-face\{[^}]*Font Awesome[^}]*\}")
USED = re.compile(r"\bfa-([\w-]+)")


def change_page(app: Any, pagename: str, templatename: str, context: dict[str, Any], doctree: Any) -> None:
    """Take Thebe's scripts and style off a page, and name the entries of a bibliography as items."""
    for kind in ("script_files", "css_files"):
        context[kind] = [file for file in context[kind] if not is_thebe(file)]
    if "body" in context:
        context["body"] = context["body"].replace('role="doc-biblioentry"', 'role="listitem"')


def is_thebe(file: Any) -> bool:
    """Tell whether a script or style of a page is Thebe's."""
    name = str(getattr(file, "filename", "") or "")
    body = str(getattr(file, "attributes", {}).get("body") or "")
    return "thebe" in name or "THEBE" in body


def finish(app: Any, exception: Exception | None) -> None:
    """Drop from the built pages what no reader loads."""
    if exception or app.builder.format != "html":
        return
    site, static = Path(app.outdir), Path(app.outdir) / "_static"
    for unread in (path for pattern in UNREAD for path in static.glob(pattern)):
        unread.unlink()
    script, style = static / DRAWN, static / STYLE
    naming = [path for path in (*site.rglob("*.html"), *static.rglob("*.js")) if path != script]
    used = {name for path in naming for name in USED.findall(path.read_text(encoding="utf-8", errors="ignore"))}
    drawn, kept = reduce_icons(script.read_text(encoding="utf-8"), used)
    if not kept:
        raise ValueError(f"{script.name} has none of the icons {sorted(used)}: the theme's script has another form")
    script.write_text(drawn, encoding="utf-8")
    search = (static / SEARCH).read_text(encoding="utf-8")
    for old, new in PATCHES:
        search, count = old.subn(new, search)
        if count != 1:
            raise ValueError(f"{SEARCH} has {count} places like {old.pattern}: the theme's script has another form")
    (static / SEARCH).write_text(search, encoding="utf-8")
    rules = FACE.sub("", style.read_text(encoding="utf-8"))
    rules = RULE.sub(lambda rule: rule[0] if used.intersection(USED.findall(rule[0])) else "", rules)
    style.write_text(rules, encoding="utf-8")
    shutil.rmtree(static / "vendor" / "fontawesome", ignore_errors=True)


def reduce_icons(script: str, used: set[str]) -> tuple[str, set[str]]:
    """Return the script with the icons of these names or aliases alone, and which of them it has."""
    kept: set[str] = set()

    def entry(icon: re.Match[str]) -> str:
        names = {icon[1] or icon[2], *re.findall(r'"([\w-]+)"', icon[3])} & used
        kept.update(names)
        return icon[0] if names else ""

    return ICON.sub(entry, script), kept


def setup(app: Any) -> dict[str, bool]:
    app.connect("html-page-context", change_page, priority=AFTER_ALL_OTHERS)
    app.connect("build-finished", finish, priority=AFTER_ALL_OTHERS)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
