"""Sphinx extension: a page for every law, laws/NAME.html, with its card, files for other languages and source."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from bench.experiments.tables.run import shown_run

FOLDER, CODE, LIVE = "laws", "laws/code", "pages/10-try-it"


def collected(app: Any) -> Iterator[tuple[str, dict, str]]:
    """(name, context, template) of each page; the files that it offers are written beside it."""
    from report.figures.cards import regulators

    run = shown_run()
    live = LIVE if LIVE in app.env.found_docs else ""
    every = [regulators.page(one, run, live) for one in regulators.every_law()]
    links = [{"link": f"{made.name}.html", "title": made.title} for made in every]
    for made, before, after in zip(every, [None, *links], [*links[1:], None], strict=False):
        for name, text in made.files.items():
            target = Path(app.outdir) / CODE / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
        yield (
            f"{FOLDER}/{made.name}",
            {"title": made.title, "body": made.body, "prev": before, "next": after},
            "page.html",
        )


def setup(app: Any) -> dict:
    app.connect("html-collect-pages", collected)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
