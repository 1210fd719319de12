"""`question`: what users of robot libraries asked, as cases that run."""

import json
import math
import textwrap
from pathlib import Path

import rich_click as click
from click.exceptions import Exit

from bench.cli.screen import examples

EPILOG = examples(
    ("All of them", "question"),
    ("One: symptom, cause and cure, measured now", "question lerobot-3691"),
    ("Its picture", "question lerobot-3691 --out tumble.svg"),
    after="Nobody's code runs: what a thread describes is restated in a few lines.\n"
    "Exit code 1: a symptom that does not show, or a cure that does not cure.",
)
WIDTH = 100


@click.command("question", epilog=EPILOG)
@click.argument("name", required=False)
@click.option("--out", type=click.Path(path_type=Path), metavar="FILE", help="Draw it: .svg, .png or .pdf.")
@click.option("--json", "as_json", is_flag=True, help="All of it for machines, on the screen.")
def COMMAND(name: str | None, out: Path | None, as_json: bool):
    """Measure what a public thread asked: its symptom, the cause, and what the cure leaves of it.

    Without NAME all questions are listed.
    """
    from bench.errors import UnknownWord
    from bench.questions.question import every_question, find, question

    if name is None:
        if out or as_json:
            raise UnknownWord("question", "", sorted(every_question()))
        for key, one in every_question().items():
            click.echo(f"{key:24}{one.title}")
        return
    one = question(name)
    found = find(one)
    if as_json:
        text = {
            field: getattr(one, field) for field in ("name", "title", "threads", "asked", "cause", "cure", "x", "y")
        }
        click.echo(json.dumps(text | found._asdict(), indent=1, ensure_ascii=False))
    else:
        lines = {
            "asked": one.asked,
            "symptom": f"{number(found.symptom)}: {one.y}; {one.x} {number(found.at)}",
            "cause": one.cause,
            "cure": one.cure,
            "cured": f"{number(found.cured)} at the most",
            "threads": ", ".join(f"github.com/{thread.replace('#', '/issues/')}" for thread in one.threads),
        }
        click.echo(f"{one.name}: {one.title}\n")
        for head, said in lines.items():
            click.echo(textwrap.fill(said, WIDTH, initial_indent=f"{head:9}", subsequent_indent=" " * 9))
    if out:
        from bench.questions.picture import picture

        picture(one, out)
    if not (found.shows and found.cures):
        raise Exit(1)


def number(value: float) -> str:
    """Three digits; what is no more than rounding is 0."""
    return "0" if math.isclose(value, 0.0, abs_tol=1e-12) else f"{value:.3g}"
