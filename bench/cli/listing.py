"""`list`: what there is to run, by kind."""

import rich_click as click
from rich.table import Table

import tasks
from bench import discovery
from bench.cli import options
from bench.cli.screen import console
from bench.errors import UnknownWord

KINDS = ("regulators", "representations", "metrics", "tasks", "starts", "engines", "suites", "claims")


@click.command("list")
@click.argument("kind", required=False, metavar="[KIND]")
@options.law
def COMMAND(kind, laws):
    """What there is: regulators, representations, metrics, tasks, starts, engines, suites, claims."""
    own = options.own_laws(laws)
    if kind is not None and kind not in KINDS:
        if kind + "s" not in KINDS:
            raise UnknownWord("kind", kind, list(KINDS))
        kind += "s"
    for one in KINDS if kind is None else (kind,):
        console().print(_TABLES[one](own))


def _table(title: str, columns: tuple[str, ...], rows) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)
    for column in columns:
        table.add_column(column, style="bold" if column == columns[0] else None, overflow="fold")
    for row in rows:
        table.add_row(*map(str, row))
    return table


def _regulators(own):
    def row(one):
        on = one.coordinates if isinstance(one.coordinates, str) else ", ".join(one.coordinates)
        note = "costing only" if one.costing_only else one.property
        return one.name, on, note, one.origin or one.source

    every = (*discovery.known_regulators().values(), *own)
    return _table("Regulators", ("name", "acts on", "proved", "source"), map(row, every))


def _representations(own):
    rows = ((one.name, ", ".join(one.symbols), one.source) for one in discovery.known_representations().values())
    return _table("Representations", ("name", "coordinates", "source"), rows)


def _metrics(own):
    rows = ((one.name, one.column, one.unit, one.title) for one in discovery.known_metrics().values())
    return _table("Metrics", ("name", "column", "unit", "meaning"), rows)


def _tasks(own):
    every = map(tasks.task, tasks.names())
    return _table("Tasks", ("name", "title", "source"), ((one.name, one.title, one.source) for one in every))


def _starts(own):
    rows = ((n, len(tasks.start_set(n)), tasks.start_set_title(n)) for n in tasks.start_set_names())
    return _table("Start sets", ("name", "starts", "title"), rows)


def _engines(own):
    from bench import engines

    rows = (line.split(None, 1) for line in engines.__doc__.splitlines()[2:] if line.strip())
    return _table("Engines", ("name", "what it is"), rows)


def _suites(own):
    from bench.suites import SUITES

    rows = ((one.name, len({part.engine for part in one.slices}), one.title) for one in SUITES.values())
    return _table("Suites", ("name", "engines", "title"), rows)


def _claims(own):
    from bench import claims

    return _table("Claims", ("id", "section", "claim"), ((c.id, c.section, c.text) for c in claims.all_claims()))


_TABLES = {
    "regulators": _regulators,
    "representations": _representations,
    "metrics": _metrics,
    "tasks": _tasks,
    "starts": _starts,
    "engines": _engines,
    "suites": _suites,
    "claims": _claims,
}
