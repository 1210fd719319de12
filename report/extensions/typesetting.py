"""Sphinx extension: formulas are MathML in the page's own source; a number and its unit stay on one line.

Numbers of a page are pasted and their units typed beside them, so that the space between can only be closed when both
are there: after all that is pasted, in the text of each paragraph, caption and cell as a whole.
"""

import re
from typing import Any

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

PUNCTUATION = re.compile(r"[,.;:!?)°]+")
AFTER_PASTING = 900
SPACE = re.compile(
    r"(?<=[\d⁰¹²³⁴⁵⁶⁷⁸⁹ᵏ]) (?=(?:%|s|ms|µs|ns|m|cm|mm|kB|MB|rad|degrees|flops)(?!\w))"  # 5 ms
    r"|(?<=\bn) (?==)|(?<=\bn =) (?=\d)"  # n = 128
)
CODE = re.compile(r'<span class="pre">[^<]{19,}</span>')
"""A name that is long; a shorter one fits into any cell."""
JOINT = re.compile(r"(?<=[\w)][_/(,])(?=\w)|(?<=[\w)]\.)(?=[^\W\d])")
"""Joints of a long name, at which it may break; 1.0 has none."""
VERBATIM = (nodes.literal, nodes.math, nodes.raw)


class CloseUp(SphinxPostTransform):
    """Put a no-break space between a number and its unit, and keep the punctuation after a formula with it."""

    default_priority = AFTER_PASTING

    def run(self, **kwargs: Any) -> None:
        for block in self.document.findall(nodes.TextElement):
            if not isinstance(block.parent, nodes.TextElement) and not isinstance(block, nodes.FixedTextElement):
                close_up(block)
        for node in self.document.findall(nodes.math):
            keep_punctuation(node)


def close_up(block: nodes.TextElement) -> None:
    """Put the no-break spaces into one block, whose text may be cut into leaves anywhere."""
    leaves = list(block.findall(nodes.Text))
    text = SPACE.sub("\N{NO-BREAK SPACE}", "".join(leaves))
    end = 0
    for leaf in leaves:
        begin, end = end, end + len(leaf)
        if text[begin:end] != leaf and not isinstance(leaf.parent, VERBATIM):
            put_in_place(leaf, text[begin:end])


def keep_punctuation(node: nodes.math) -> None:
    """Move the punctuation that follows a formula into its node, so that no line begins with it."""
    following = node.next_node(descend=False, siblings=True)
    found = PUNCTUATION.match(following.astext()) if isinstance(following, nodes.Text) else None
    if found:
        node["punctuation"] = found[0]
        put_in_place(following, following.astext()[found.end() :])


def put_in_place(leaf: nodes.Text, text: str) -> None:
    """Put other text in the place of this leaf; docutils itself would take the first leaf of the same text."""
    place = next(i for i, one in enumerate(leaf.parent.children) if one is leaf)
    leaf.parent[place] = nodes.Text(text)


def let_names_break(app: Any, pagename: str, templatename: str, context: dict[str, Any], doctree: Any) -> None:
    """Let a long name of code break after its underscores, dots and slashes, and nowhere else."""
    if "body" in context:
        context["body"] = CODE.sub(lambda name: JOINT.sub("<wbr>", name[0]), context["body"])


def inline(self: Any, node: nodes.math) -> None:
    from report.figures.kit import mathml

    formula, punctuation = mathml.inline(node.astext()), node.get("punctuation")
    self.body.append(f'<span class="together">{formula}{punctuation}</span>' if punctuation else formula)
    raise nodes.SkipNode


def block(self: Any, node: nodes.math_block) -> None:
    from report.figures.kit import mathml

    self.body.append(mathml.block(node.astext()))
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    app.add_post_transform(CloseUp)
    app.connect("html-page-context", let_names_break)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
