"""Sphinx extension: formulas are MathML in the page's own source; no script sets them when it is read."""

from __future__ import annotations

from docutils import nodes


def inline(self, node) -> None:
    from report.figures.kit import mathml

    self.body.append(mathml.inline(node.astext()))
    raise nodes.SkipNode


def block(self, node) -> None:
    from report.figures.kit import mathml

    self.body.append(mathml.block(node.astext()))
    raise nodes.SkipNode


def setup(app) -> dict:
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
