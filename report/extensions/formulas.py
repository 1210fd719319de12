"""Sphinx extension: formulas are MathML in the page's own source; no script sets them when it is read."""

from __future__ import annotations

import re

from docutils import nodes

PUNCTUATION = re.compile(r"[,.;:!?)°]+")


def keep_punctuation(app, doctree, name: str) -> None:
    """Move the punctuation that follows a formula into its node, so that no line begins with it."""
    for node in doctree.findall(nodes.math):
        following = node.next_node(descend=False, siblings=True)
        found = PUNCTUATION.match(following.astext()) if isinstance(following, nodes.Text) else None
        if found:
            node["punctuation"] = found[0]
            following.parent.replace(following, nodes.Text(following.astext()[found.end() :]))


def inline(self, node) -> None:
    from report.figures.kit import mathml

    formula, punctuation = mathml.inline(node.astext()), node.get("punctuation")
    self.body.append(f'<span class="together">{formula}{punctuation}</span>' if punctuation else formula)
    raise nodes.SkipNode


def block(self, node) -> None:
    from report.figures.kit import mathml

    self.body.append(mathml.block(node.astext()))
    raise nodes.SkipNode


def setup(app) -> dict:
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    app.connect("doctree-resolved", keep_punctuation)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
