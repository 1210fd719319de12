"""Sphinx extension: a frame that a page writes as HTML is a figure with a number, so that people can cite it.

Sphinx numbers its own figures only. This makes one of each `<figure class="ball-view">` of a page: the balls of the
chapters. The name of what the frame shows, ball.html#NAME, becomes its label, fig-ball-NAME.
"""

import html
import re
from typing import Any

from docutils import nodes
from sphinx.transforms import SphinxTransform

FIGURE = re.compile(
    r'<figure class="(?P<kind>ball-view)">\s*(?P<frame><iframe.*?</iframe>)\s*'
    r"<figcaption>(?P<caption>.*?)</figcaption>\s*</figure>",
    re.DOTALL,
)
TAG = re.compile(r"(<[^>]+>)")
SHOWN = re.compile(r'src="[^"]*#([\w-]+)"')
LABEL = "fig-ball-{}"


class NumberFrames(SphinxTransform):
    """Puts a figure with a caption in the place of each such piece of HTML."""

    default_priority = 400

    def apply(self, **_: Any) -> None:
        """Change the document of a page."""
        for raw in list(self.document.findall(nodes.raw)):
            found = FIGURE.fullmatch(raw.astext().strip())
            if found and raw.get("format") == "html":
                raw.replace_self(self.make_figure(found))

    def make_figure(self, found: re.Match[str]) -> nodes.figure:
        """Return the figure of one frame, under its label."""
        shown = SHOWN.search(found["frame"])
        if not shown:
            raise ValueError(f'a frame does not say what it shows: {found["frame"]} (cure: src="ball.html#NAME")')
        label = LABEL.format(shown[1])
        caption = nodes.caption("", "", *split_tags(found["caption"]))
        figure = nodes.figure("", nodes.raw("", found["frame"], format="html"), caption)
        figure["classes"].append(found["kind"])
        figure["names"].append(label)
        self.document.note_explicit_target(figure)
        return figure


def split_tags(caption: str) -> list[nodes.Node]:
    """Return words as text, which Sphinx asks of a caption that is to have a number, and tags as they are."""
    parts: list[nodes.Node] = []
    for part in TAG.split(caption):
        if TAG.fullmatch(part):
            parts.append(nodes.raw("", part, format="html"))
        elif part:
            parts.append(nodes.Text(html.unescape(part)))
    return parts


def setup(app: Any) -> dict[str, bool]:
    app.add_transform(NumberFrames)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
