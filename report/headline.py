"""The headline figure as files: report/_static/media/headline.png for README, and card.png for shared links.

    python report/headline.py     draws both from results/reference, and says in media.json what they show

They need no GL and no browser: matplotlib draws the figure of the pages once more, on white paper.
"""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
from drawing import MEDIA, THEMES
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from PIL import Image

from bench.base.provenance import ROOT
from bench.base.provenance import describe as describe_machine
from bench.experiments.tables.run import run_in
from report.figures.failures import failure_map
from report.figures.kit import style

RESULTS = ROOT / "results" / "reference"
CONFIGURATION = ROOT / "report" / "_config.yml"
CARD_PIXELS = (1200, 630)
"""Size of the picture of a shared link."""
DOTS_PER_INCH = 192
"""Two pixels to one of CSS."""
COLOURS = 255


def read_title(configuration: Path = CONFIGURATION) -> str:
    """Return the book's title."""
    found = re.search(r'^title: "(.*)"$', configuration.read_text(encoding="utf-8"), re.MULTILINE)
    if not found:
        raise ValueError(f'{configuration} has no line title: "..." (cure: write the title in double quotes)')
    return found[1]


def read_episodes() -> Any:
    """Return the episodes that the figure is drawn from."""
    return run_in(RESULTS).rows("episodes", engine="ideal-rk4")


def describe() -> dict[str, Any]:
    """Return what the files show and where it comes from."""
    episodes = read_episodes()
    lost = {}
    for contender, rows in failure_map.find_common_starts(episodes).items():
        lost[contender] = {kind: list(numbers) for kind, numbers in failure_map.count_lost(rows).items()}
    return {
        "results": RESULTS.relative_to(ROOT).as_posix(),
        "title": read_title(),
        "never_settle": lost,
        "alt": failure_map.draw_hero(episodes, narrow=False)[1],
    }


def draw_dots_as_markers(figure: Figure) -> None:
    """Replace what `style.dots` drew: Agg leaves out segments of no length, which a browser draws as dots."""
    for axes in figure.axes:
        for patch in [one for one in axes.findobj(PathPatch) if not one.get_fill()]:
            places = np.asarray(patch.get_path().vertices)[::2]
            look = {"color": patch.get_edgecolor(), "markersize": patch.get_linewidth(), "zorder": patch.get_zorder()}
            axes.plot(*places.T, "o", markeredgewidth=0.0, **look)
            patch.remove()


def save(figure: Figure, name: str, dots_per_inch: float) -> None:
    """Write a figure on white paper, in so few colours that the file is small."""
    draw_dots_as_markers(figure)
    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(dots_per_inch)
    figure.set_facecolor(tuple(value / 255.0 for value in THEMES[0].paper))
    canvas.draw()
    picture = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    picture.quantize(COLOURS, dither=Image.Dither.NONE).save(MEDIA / name, optimize=True)


def draw() -> None:
    """Draw both files."""
    episodes = read_episodes()
    with rc_context(fname=style.PAPER_STYLE):
        figure, _ = failure_map.draw_hero(episodes, narrow=False)
        save(figure, "headline.png", DOTS_PER_INCH)
        width, height = CARD_PIXELS
        dots_per_inch = width / style.TEXT_WIDTH_IN
        card, _ = failure_map.draw_hero(episodes, narrow=False, height=height / dots_per_inch)
        card.suptitle(read_title(), x=0.02, ha="left", fontsize=15, fontweight="bold")
        save(card, "card.png", dots_per_inch)


def main() -> None:
    """Draw both files, and write what they show beside what is said of the other files."""
    draw()
    path = MEDIA / "media.json"
    about = json.loads(path.read_text(encoding="utf-8"))
    about["headline"] = {"commit": describe_machine()["commit"], **describe()}
    path.write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
