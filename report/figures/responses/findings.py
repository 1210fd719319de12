"""Paste numbers, for pages whose module does not do it yet."""

from report.figures.kit import html


def glue_all(values: dict) -> None:
    """Make every number available to the page's text under its key."""
    from myst_nb import glue

    for key, value in values.items():
        glue(key, html.cell(value), display=False)
