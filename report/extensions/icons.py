"""Sphinx extension: of the theme's icons only those that a page shows.

The theme ships two thousand, twice: as a script that draws them, 1.5 MB on every page, and as fonts for the moment
before that script has run.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path

AFTER_ALL_OTHERS = 999
DRAWN = Path("scripts") / "fontawesome.js"
STYLE = Path("styles") / "pydata-sphinx-theme.css"
# "name":[width,height,["alias", ...],"code point",path or paths],
ICON = re.compile(r'(?:"([\w-]+)"|\b(\w+)):\[\d+,\d+,\[([^\]]*)\],"[0-9a-f]+",(?:"[^"]*"|\[[^\]]*\])\],?')
# .fa-name:before,.fa-alias:before{content:"..."}
RULE = re.compile(r'(?:\.fa-[\w-]+:before,?)+\{content:"[^"]*"\}')
FACE = re.compile(r"@font-face\{[^}]*Font Awesome[^}]*\}")
USED = re.compile(r"\bfa-([\w-]+)")


def only_used(app, exception) -> None:
    """Rewrite the theme's script and style without the icons that nothing in the site names."""
    if exception or app.builder.format != "html":
        return
    site, static = Path(app.outdir), Path(app.outdir) / "_static"
    script, style = static / DRAWN, static / STYLE
    naming = [path for path in (*site.rglob("*.html"), *static.rglob("*.js")) if path != script]
    used = {name for path in naming for name in USED.findall(path.read_text(encoding="utf-8", errors="ignore"))}
    drawn, kept = reduced(script.read_text(encoding="utf-8"), used)
    if not kept:
        raise ValueError(f"{script.name} has none of the icons {sorted(used)}: the theme's script has another form")
    script.write_text(drawn, encoding="utf-8")
    rules = FACE.sub("", style.read_text(encoding="utf-8"))
    rules = RULE.sub(lambda rule: rule[0] if used.intersection(USED.findall(rule[0])) else "", rules)
    style.write_text(rules, encoding="utf-8")
    shutil.rmtree(static / "vendor" / "fontawesome", ignore_errors=True)


def reduced(script: str, used: set[str]) -> tuple[str, set[str]]:
    """Return the script with the icons of these names or aliases alone, and which of them it has."""
    kept: set[str] = set()

    def entry(icon: re.Match) -> str:
        names = {icon[1] or icon[2], *re.findall(r'"([\w-]+)"', icon[3])} & used
        kept.update(names)
        return icon[0] if names else ""

    return ICON.sub(entry, script), kept


def setup(app) -> dict:
    app.connect("build-finished", only_used, priority=AFTER_ALL_OTHERS)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
