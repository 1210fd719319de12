"""Texts of a figure that overlap each other or leave the figure, by matplotlib's own bounding boxes."""

import itertools

from matplotlib.figure import Figure
from matplotlib.text import Text
from mpl_toolkits.mplot3d.art3d import Text3D

SLACK = 3.0
"""Points by which boxes may overlap: a box has room for letters with accents and descenders."""


def find_clashes(figure: Figure) -> list[str]:
    """Return one line for each pair of texts that overlap, and for each text that leaves the figure.

    Texts at a slant are left out, because their boxes are larger than they are, and texts placed in space.
    """
    figure.draw_without_rendering()
    absent = list_absent(figure)
    seen = [one for one in figure.findobj(Text) if one.get_visible() and one.get_text().strip() and one not in absent]
    flat = [one for one in seen if one.get_rotation() % 90.0 == 0.0 and not isinstance(one, Text3D)]
    boxes = [(one.get_text(), one.get_window_extent()) for one in flat]
    found = []
    for (one, a), (other, b) in itertools.combinations(boxes, 2):
        if min(a.x1, b.x1) - max(a.x0, b.x0) > SLACK and min(a.y1, b.y1) - max(a.y0, b.y0) > SLACK:
            found.append(f"{one!r} overlaps {other!r}")
    whole = figure.bbox.padded(SLACK)
    leaving = [text for text, box in boxes if not (whole.contains(*box.min) and whole.contains(*box.max))]
    return found + [f"{text!r} leaves the figure" for text in leaving]


def list_absent(figure: Figure) -> set[Text]:
    """Return the labels of ticks that are not drawn: outside the limits, or of axes that are off."""
    absent: set[Text] = set()
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
                if not axes.axison or not axis.get_visible() or not low <= tick.get_loc() <= high:
                    absent |= {tick.label1, tick.label2}
    return absent
