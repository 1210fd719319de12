"""Sphinx extension: a number and its unit stay on one line.

Numbers of a page are pasted and their units typed beside them, so that the space between can only be closed when both
are there: after all that is pasted, in the text of each paragraph, caption and cell as a whole.
"""

from __future__ import annotations

import re

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

AFTER_PASTING = 900
SPACE = re.compile(
    r"(?<=[\d⁰¹²³⁴⁵⁶⁷⁸⁹ᵏ]) (?=(?:%|s|ms|µs|ns|m|cm|mm|kB|MB|rad|degrees|flops)(?!\w))"  # 5 ms
    r"|(?<=\bn) (?==)|(?<=\bn =) (?=\d)"  # n = 128
)
NO_BREAK_SPACE = "\N{NO-BREAK SPACE}"
VERBATIM = (nodes.literal, nodes.math, nodes.raw)


class CloseUp(SphinxPostTransform):
    """Put a no-break space between a number and its unit."""

    default_priority = AFTER_PASTING

    def run(self, **kwargs) -> None:
        for block in self.document.findall(nodes.TextElement):
            if not isinstance(block.parent, nodes.TextElement) and not isinstance(block, nodes.FixedTextElement):
                close_up(block)


def close_up(block: nodes.TextElement) -> None:
    """Put the no-break spaces into one block, whose text may be cut into leaves anywhere."""
    leaves = list(block.findall(nodes.Text))
    text = SPACE.sub(NO_BREAK_SPACE, "".join(leaves))
    end = 0
    for leaf in leaves:
        begin, end = end, end + len(leaf)
        if text[begin:end] != leaf and not isinstance(leaf.parent, VERBATIM):
            leaf.parent.replace(leaf, nodes.Text(text[begin:end]))


def setup(app) -> dict:
    app.add_post_transform(CloseUp)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
