"""A drawn figure as inline SVG: follows the page's light and dark, described in words, at home on a phone.

Inline, because an `<img>` sees nothing of the page's theme. Each colour of `style.TWINS` becomes a variable
of `light-dark(light, dark)`, which the theme's `color-scheme` decides. Ids are the figure's own, so figures
share a page. Words are text, which a reader selects and finds: the page has the font in which matplotlib measured them.
"""

import functools
import html
import io
import itertools
import re
from collections.abc import Callable
from typing import Any, NamedTuple

from matplotlib import rc_context
from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_svg import FigureCanvasSVG, RendererSVG
from matplotlib.figure import Figure
from matplotlib.text import Text
from mpl_toolkits.mplot3d.art3d import Text3D

from report.figures.kit import style

USED_ID = re.compile(r"""(?:url\(#|href="#)([^)"]+)""")
ID = re.compile(r'\s+id="([^"]*)"')
COLOUR = re.compile("|".join(style.TWINS), re.IGNORECASE)
PATH = re.compile(r'\bd="[^"]*"')
DOT = re.compile(r"M (\S+ \S+)\s+L \1(?=\s)")  # of `dots`: a segment of no length says its place once
LONG_NUMBER = re.compile(r"(\d\.\d{2})\d+")  # of a path, in points: a hundredth is invisible
# What matplotlib says in a <style> element, which inline would hold for the whole page:
STROKES = "stroke-linejoin: round; stroke-linecap: butt"
FONT = "font: 400 10px 'Orientation Sans', 'DejaVu Sans', sans-serif; font-variant: normal; letter-spacing: 0"
"""Font of every word of a figure; a word says only what differs, so that it looks alike in a caption or a heading."""
FAMILY = re.compile(r" font-family: [^;\"]*;?")
BOLD, BOLD_FACE = "font-weight: 700", "font-weight: 600"
"""What matplotlib calls bold, and the weight of the face that it measures, OrientationSans-Bold.ttf."""
NO_TURN = re.compile(r' transform="rotate\(-0 [^)]*\)"')
BLANKS = re.compile(r"[ \t\r\n]+")  # not the narrow spaces inside numbers


Drawing = tuple[Figure, str]
"""A figure, and its alternative text."""
POINTS_PER_INCH, CSS_PIXELS_PER_INCH = 72, 96  # the units of an SVG, in which text is measured, and of a page
SLACK = 3.0
"""Points by which boxes of texts may overlap: a box has room for letters with accents and descenders."""


class Picture(NamedTuple):
    """Inline SVG for a page, the words that stand for it where it cannot be seen, and texts of it that overlap."""

    wide: str
    alt: str
    narrow: str
    clashes: tuple[str, ...]

    def _repr_html_(self) -> str:
        return f'<div class="picture wide">{self.wide}</div><div class="picture narrow">{self.narrow}</div>'


def responsive_picture(draw: Callable[..., Drawing]) -> Callable[..., Picture]:
    """Decorate a function that draws: it draws twice, with the keyword `narrow` for a phone."""

    @functools.wraps(draw)
    def drawn(*args: Any, **kwargs: Any) -> Picture:
        name = draw.__name__
        with rc_context(fname=style.PAPER_STYLE):
            figure, alt = draw(*args, narrow=False, **kwargs)
            phone, _ = draw(*args, narrow=True, **kwargs)
            texts = svg(figure, alt, name), alt, svg(phone, alt, f"{name}-narrow")
            return Picture(*texts, (*find_clashes(figure), *find_clashes(phone)))

    return drawn


def svg(figure: Figure, alt: str, name: str) -> str:
    """Return the figure as an `<svg>` element that names its colours and describes itself."""
    if not alt.strip():
        raise ValueError(
            f"figure {name} has no alternative text (cure: return (figure, 'what it shows, in a sentence'))"
        )
    lay_out(figure)
    text = write_svg(figure)
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>|<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"<defs>\s*</defs>", "", text)
    text = NO_TURN.sub("", FAMILY.sub("", text)).replace(BOLD, BOLD_FACE)
    text = PATH.sub(lambda path: DOT.sub(r"M \1h0", LONG_NUMBER.sub(r"\1", path[0])), text)
    text = own_ids(text, name.replace("_", "-"), alt)
    # Every colour that has a twin becomes its variable; attributes become styles, which allow one.
    text = re.sub(r'\b(fill|stroke)="(#[0-9a-fA-F]{6})"', r'style="\1: \2"', text)
    text = COLOUR.sub(lambda found: f"var({variable(found[0])})", text)
    twins = [(variable(light), light, dark) for light, dark in style.TWINS.items()]
    colours = "; ".join(f"{name}: light-dark({light}, {dark})" for name, light, dark in twins if name in text)
    words, width = html.escape(alt, quote=True), figure.get_figwidth() * CSS_PIXELS_PER_INCH
    text = re.sub(r'\s+(?:width|height)="[\d.]+pt"', "", text, count=2)
    opening = f'<svg role="img" aria-label="{words}" style="max-width: {width:.0f}px; {FONT}; {STROKES}; {colours}"'
    return BLANKS.sub(" ", text.replace("<svg", opening, 1)).strip()


class TextRenderer(RendererSVG):
    """Writes words as text; mathematics stays outlines, for its fonts are not the page's."""

    def draw_text(self, gc: Any, x: float, y: float, s: str, prop: Any, angle: float, *more: Any, **named: Any) -> None:
        """Draw one text; the last arguments are matplotlib's: whether it is mathematics, and the Text itself."""
        is_mathematics = bool(more[0]) if more else bool(named.get("ismath"))
        if not is_mathematics:
            super().draw_text(gc, x, y, s, prop, angle, *more, **named)
            return
        with rc_context({"svg.fonttype": "path"}):
            super().draw_text(gc, x, y, s, prop, angle, *more, **named)


def write_svg(figure: Figure) -> str:
    """Return the figure as matplotlib's `print_svg` writes it, by our renderer and without a date."""
    raw = io.StringIO()
    width, height = figure.get_size_inches()
    size = width * POINTS_PER_INCH, height * POINTS_PER_INCH
    nothing = {"Date": None, "Creator": None, "Format": None, "Type": None}
    words = TextRenderer(*size, raw, image_dpi=POINTS_PER_INCH, metadata=nothing)
    renderer = MixedModeRenderer(figure, width, height, POINTS_PER_INCH, words)
    figure.draw(renderer)
    renderer.finalize()
    return raw.getvalue()


def lay_out(figure: Figure) -> None:
    """Place the axes as `savefig` would, which draws all twice for it, and hold them there."""
    FigureCanvasSVG(figure)
    figure.set_dpi(POINTS_PER_INCH)
    layout = figure.get_layout_engine()
    if layout is not None:
        layout.execute(figure)
        figure.set_layout_engine("none")


def own_ids(text: str, name: str, alt: str = "") -> str:
    """Keep the ids that are referred to, each under this figure's name."""
    # The content decides, not only the name: one function may draw several figures of a page. So do its words:
    # two laws may fail alike.
    prefix = f"{name}-{style.mark(text + alt):08x}-"
    used = set(USED_ID.findall(text))
    text = ID.sub(lambda found: f' id="{prefix}{found[1]}"' if found[1] in used else "", text)
    return USED_ID.sub(lambda found: found[0].replace(f"#{found[1]}", f"#{prefix}{found[1]}"), text)


def variable(colour: str) -> str:
    """Return the name of a colour's variable."""
    return f"--c{colour[1:].lower()}"


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
