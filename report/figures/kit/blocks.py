"""Block diagrams: blocks, sums and wires on a board that runs to the right, or downwards on a phone.

A place is (along, across): along the flow of the signal and across it, in steps of the board's pitch, so that one
description draws both.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyBboxPatch

from report.figures.kit import style

SUM_RADIUS_IN = 0.11
ROUNDING_IN = 0.06


class Node(NamedTuple):
    """Where a block stands: centre and half sizes [in]; a plain point has none."""

    x: float
    y: float
    half_width: float = 0.0
    half_height: float = 0.0


class Board:
    """A figure of the page's width that blocks and wires are put on.

    Args:
        height, narrow_height: of the figure, drawn for a page and for a phone [in].
        pitch, narrow_pitch: inches between places (along, across).
        origin, narrow_origin: inches of the place (0, 0) from the top left corner.
    """

    def __init__(self, narrow, height, narrow_height, pitch, narrow_pitch, origin, narrow_origin):
        self.narrow = narrow
        self.pitch = narrow_pitch if narrow else pitch
        self.origin = narrow_origin if narrow else origin
        width = style.PHONE_WIDTH_IN if narrow else style.TEXT_WIDTH_IN
        tall = narrow_height if narrow else height
        self.figure = Figure(figsize=(width, tall))
        self.figure.set_layout_engine("none")
        self.axes = self.figure.add_axes((0, 0, 1, 1))
        self.axes.set(xlim=(0, width), ylim=(-tall, 0))
        self.axes.axis("off")
        self.nodes: dict[str, Node] = {}

    def place(self, along: float, across: float) -> tuple[float, float]:
        """Inches of a place; y points up from the top edge."""
        one, other = along * self.pitch[0], across * self.pitch[1]
        right, down = (other, one) if self.narrow else (one, other)
        return self.origin[0] + right, -self.origin[1] - down

    def block(self, name, at, text, size=(1.2, 0.56), colour=style.MUTED, heading="", weight=0.9):
        """A box with words; `heading` stands in bold above them."""
        x, y = self.place(*at)
        half_width, half_height = size[0] / 2, size[1] / 2
        self.nodes[name] = Node(x, y, half_width, half_height)
        corner = (x - half_width, y - half_height)
        shape = f"round,pad=0,rounding_size={ROUNDING_IN}"
        self.axes.add_patch(
            FancyBboxPatch(
                corner, size[0], size[1], boxstyle=shape, facecolor=style.PAPER, edgecolor=colour, linewidth=weight
            )
        )
        if heading:
            top = y + half_height - 0.09
            self.axes.text(x, top, heading, ha="center", va="top", fontsize=10, fontweight="bold", color=style.INK)
            y -= 0.1
        self.axes.text(x, y, text, ha="center", va="center", fontsize=10, color=style.INK, linespacing=1.2)

    def sum(self, name, at):
        """A circle in which signals meet."""
        x, y = self.place(*at)
        self.nodes[name] = Node(x, y, SUM_RADIUS_IN, SUM_RADIUS_IN)
        self.axes.add_patch(Circle((x, y), SUM_RADIUS_IN, facecolor=style.PAPER, edgecolor=style.INK, linewidth=0.9))

    def point(self, name, at):
        """A place where a wire begins or ends."""
        self.nodes[name] = Node(*self.place(*at))

    def wire(self, start, end, via=(), arrow=True, colour=style.INK, dashed=False):
        """A line from block to block, over places, with a head at its end."""
        corners = [self.place(*place) for place in via]
        first, last = self.nodes[start], self.nodes[end]
        begin = edge(first, corners[0] if corners else (last.x, last.y))
        finish = edge(last, corners[-1] if corners else (first.x, first.y))
        path = [begin, *corners, finish]
        x, y = zip(*path, strict=True)
        line = (0, (3, 2)) if dashed else "-"
        self.axes.plot(x, y, color=colour, linewidth=1.1, linestyle=line, solid_joinstyle="round", zorder=1)
        if arrow:
            tail = path[-2]
            head = {"arrowstyle": "-|>,head_length=0.42,head_width=0.17", "color": colour, "linewidth": 0.6}
            near = (finish[0] + 0.02 * (tail[0] - finish[0]), finish[1] + 0.02 * (tail[1] - finish[1]))
            self.axes.annotate("", finish, near, arrowprops={**head, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 12})

    def label(self, at, text, colour=style.INK, shift=(0.0, 0.0), **place):
        """Words beside a wire, shifted by inches right and up."""
        x, y = self.place(*at)
        place = {"ha": "center", "va": "bottom", "fontsize": 10, **place}
        self.axes.text(x + shift[0], y + shift[1], text, color=colour, **place)


def edge(node: Node, towards: tuple[float, float]) -> tuple[float, float]:
    """Where a wire from the block towards a point leaves its box: straight out if the point is level with the box."""
    dx, dy = towards[0] - node.x, towards[1] - node.y
    if not node.half_width:
        return node.x, node.y
    if abs(dx) < node.half_width:
        return node.x + dx, node.y + math.copysign(node.half_height, dy)
    if abs(dy) < node.half_height:
        return node.x + math.copysign(node.half_width, dx), node.y + dy
    scale = min(node.half_width / abs(dx), node.half_height / abs(dy))
    return node.x + scale * dx, node.y + scale * dy
