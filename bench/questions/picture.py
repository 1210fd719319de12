"""A question's curves as a drawing: one line as it was asked about, one with the cure."""

from __future__ import annotations

from pathlib import Path

from bench.errors import MissingTool
from bench.questions.question import Curves, Question

COLOURS = ("#c23b22", "#1b7f79")


def draw(axes, question: Question, curves: Curves, colours: tuple[str, str] = COLOURS) -> None:
    """Both lines, on matplotlib's axes; on a logarithmic scale what is zero lies on the edge."""
    as_asked, cured = colours
    axes.plot(curves.x, curves.before, color=as_asked, linewidth=1.4, label="as asked")
    axes.plot(curves.x, curves.after, color=cured, linewidth=1.4, linestyle=(0, (4, 2)), label="cured")
    axes.set_xscale("log" if question.is_log_x else "linear")
    axes.set_yscale("log" if question.is_log_y else "linear")
    axes.set_xlabel(question.x)
    axes.set_ylabel(question.y)


def picture(question: Question, path: Path) -> None:
    """The drawing as a file, of the kind that its ending says (.svg, .png, .pdf).

    Errors:
        MissingTool: matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise MissingTool("a picture needs matplotlib, which is not installed (try: make setup)") from None
    figure = Figure(figsize=(6.4, 3.8), layout="constrained")
    axes = figure.subplots()
    draw(axes, question, question.curves())
    axes.set_title(question.title)
    axes.legend()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)
