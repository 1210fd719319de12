"""Sphinx extension: the page of the balls in the chapters, pages/ball.html, with nothing that they do not show.

It is the live page's part for its script (cards/live.html), its data and its laws, without theme,
search and fonts: a frame loads this page and its scripts alone. Where no script runs, and on paper,
a picture of the live page stands for the frame.
"""

import html
import re
from pathlib import Path
from typing import Any

LIVE, BALL = Path("pages") / "10-try-it.html", Path("pages") / "ball.html"
PART = re.compile(r'<section id="live-page".*?</section>', re.DOTALL)
SCRIPT = re.compile(r'<script[^>]*\bid="live-(?:data|laws)"[^>]*>.*?</script>', re.DOTALL)
LOADED = re.compile(r'<script src="\.\./[\w-]+\.js" defer></script>')
FRAME = re.compile(r'<iframe src="(?:\.\./pages/)?ball\.html#([\w-]+)"[^>]*></iframe>')
LABEL = re.compile(r'aria-label="([^"]*)"')
WHOLE_PAGE = "10-try-it.html?"
STILLS = "_static/media/live-{}.png"
WITHOUT_SCRIPT = """
<noscript><style>.ball-view iframe { display: none } .ball-still { display: block !important }</style></noscript>
"""
PAGE = """\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="robots" content="noindex">
<title>The ball of starts</title>
<base target="_parent">
<script src="../ball-page.js"></script>
<link rel="stylesheet" href="../live.css">
<link rel="stylesheet" href="../ball.css">
</head>
<body>
<main>
<article>
<h1>The ball of starts</h1>
{part}
<noscript><p>The ball is drawn by a script. This browser runs none.</p></noscript>
</article>
</main>
{scripts}
</body>
</html>
"""


def change_page(app: Any, pagename: str, templatename: str, context: dict[str, Any], doctree: Any) -> None:
    """Put a picture beside each frame of a chapter, and load the script that gives the frames their height."""
    body = context.get("body", "")
    if WHOLE_PAGE in body:
        raise ValueError(f"{pagename} has a frame with {WHOLE_PAGE}...: take ball.html#PRESET, which loads less")
    if not FRAME.search(body):
        return

    def add_still(frame: re.Match[str]) -> str:
        preset = frame[1]
        name = STILLS.format(preset)
        if not (Path(app.srcdir) / name).is_file():
            raise ValueError(f"{pagename} has a ball of {preset} without {name} (cure: report/stills.py)")
        words = LABEL.search(frame[0])
        alt = words[1] if words else html.escape(preset)
        address = context["pathto"](name, 1)
        return f'{frame[0]}<img class="ball-still" src="{address}" alt="{alt}" loading="lazy">'

    script = f'<script src="{context["pathto"]("ball-frame.js", 1)}" defer></script>'
    context["body"] = FRAME.sub(add_still, body) + script
    context["metatags"] = context.get("metatags", "") + WITHOUT_SCRIPT


def write_ball(app: Any, exception: Exception | None) -> None:
    """Write the page of the ball from the built live page."""
    live = Path(app.outdir) / LIVE
    if exception or app.builder.format != "html" or not live.is_file():
        return
    (Path(app.outdir) / BALL).write_text(make_ball(live.read_text(encoding="utf-8")), encoding="utf-8")


def make_ball(live: str) -> str:
    """Return the page of the ball, from the text of the live page."""
    part = PART.search(live)
    scripts = [*SCRIPT.findall(live), *LOADED.findall(live)]
    if not part or len(scripts) < 3:
        raise ValueError(f"{LIVE} has no section live-page, or its data, laws and scripts are missing")
    return PAGE.format(part=part[0], scripts="\n".join(scripts))


def setup(app: Any) -> dict[str, bool]:
    app.connect("html-page-context", change_page)
    app.connect("build-finished", write_ball)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
