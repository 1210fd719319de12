"""What the front page shows: three fates of one start, the default, and what leads to another law."""

from typing import Any

from bench.findings.selection import words
from bench.findings.selection.regions import find_default
from bench.findings.selection.reset import describe_resets
from bench.findings.selection.robots import list_elsewhere
from report.figures.answer import which_law
from report.figures.kit import families, html, media
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import listed

PLAY = """<script>
if (matchMedia("(prefers-reduced-motion: no-preference)").matches)
  for (const film of document.querySelectorAll(".first video")) if (film.checkVisibility()) film.play().catch(() => {});
</script>"""


def facts(run: Run) -> dict[str, Any]:
    """Return the default and what it does, what leads to another law, how ours compares, and the three fates."""
    episodes = media.facts()["fates"]["episodes"]
    said = "; ".join(f"from {one['start']} {families.word(one['contender'])} {one['says']}" for one in episodes)
    loop = media.loop(f"A gripper under three laws: {said}.", "fates-loop", "_static/media", 313)
    return {
        "fates": html.Html(loop + PLAY),
        "default": families.word(find_default()),
        "attribution": which_law.describe_attribution(find_default()),
        "does": which_law.describe_default(),
        "lines": words.describe_lines(find_default(), families.word),
        "resets": describe_resets(find_default()),
        "needs": in_run(list_needs),
        "ours": which_law.describe_ours(),
    }


def list_needs() -> str:
    """Say for each law that is not the default what leads to it."""
    needs: dict[str, list[str]] = {}
    for one in list_elsewhere():
        if one.law != find_default():
            needs.setdefault(one.law, []).append(one.words)
    links = {law: families.link(law, families.word(law)).replace('href="../', 'href="', 1) for law in needs}
    return f"{listed([links[law] + ' if ' + ', or if '.join(words) for law, words in needs.items()])}."
