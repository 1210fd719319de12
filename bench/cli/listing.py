"""`list`: what there is to run, by kind."""

import itertools

import pandas as pd
import rich_click as click

import tasks
from bench.cli import options
from bench.cli.screen import Frame, console, frame_table
from bench.contenders.registry import (
    known_impedances,
    known_inverses,
    known_jacobians,
    known_regulators,
    known_representations,
)
from bench.control.contact_controller import HYBRIDS
from bench.control.registry import all_controllers
from bench.errors import UnknownWord
from bench.experiments.contact import can_do
from bench.experiments.experiment import known_experiments
from bench.metrics.registry import known_contact_metrics, known_metrics
from tasks.arm import arms
from tasks.arm_model import Arm
from tasks.base import BadArm


@click.command("list")
@click.argument("kind", required=False, metavar="[KIND]")
@options.law
def COMMAND(kind, laws):
    """What there is to run, of one kind or of all.

    Kinds: regulators, representations, jacobians, inverses, controllers, impedances, metrics, tasks, arms, variations,
    axes, starts, engines, suites, experiments, claims. A file of an arm that cannot be used is listed with the reason.
    """
    own = options.own_laws(laws)
    if kind is not None and kind not in _TABLES:
        plural = {"axis": "axes"}.get(kind, kind + "s")
        if plural not in _TABLES:
            raise UnknownWord("kind", kind, list(_TABLES))
        kind = plural
    for one in _TABLES if kind is None else (kind,):
        console().print(_TABLES[one](own))


def _table(title: str, columns: tuple[str, ...], rows) -> Frame:
    return frame_table(pd.DataFrame([[*map(str, row)] for row in rows], columns=list(columns)), title)


def _regulators(own):
    def row(one):
        on = one.coordinates if isinstance(one.coordinates, str) else ", ".join(one.coordinates)
        note = "costing only" if one.costing_only else one.property
        return one.name, on, note, one.origin or one.source

    every = (*known_regulators().values(), *own)
    return _table("Regulators", ("name", "acts on", "proved", "source"), map(row, every))


def _representations(own):
    rows = ((one.name, ", ".join(one.symbols), one.source) for one in known_representations().values())
    return _table("Representations", ("name", "coordinates", "source"), rows)


def _jacobians(own):
    every = known_jacobians().values()
    rows = ((one.name, one.takes.replace("-", " "), one.title, one.source) for one in every)
    return _table("Jacobians", ("name", "takes", "title", "source"), rows)


SHAPES = ((6, 6), (6, 7), (7, 6), (7, 7))
"""Rows and columns of a Jacobian: three of position, with three coordinates of orientation or four; six joints or
seven."""


def _inverses(own):
    def row(one):
        shapes = ", ".join(f"{rows} x {n}" for rows, n in SHAPES if not one.refuses(rows, n))
        return one.name, one.gives, shapes, one.title, one.source

    columns = ("name", "gives", "Jacobians it takes", "title", "source")
    return _table("Inverses", columns, map(row, known_inverses().values()))


def _controllers(own):
    every = all_controllers()
    titles = {one.law: f"impedance: {one.impedance.title}" for one in every if one.impedance}

    def row(law):
        some = [one for one in every if one.law == law]
        along = dict.fromkeys(one.representation.name for one in some if one.representation)
        forms = dict.fromkeys(one.form for one in some if one.form)
        return law, ", ".join(along), ", ".join(forms), {**HYBRIDS, **titles}[law]

    columns = ("name", "/coordinates", "+form", "what it is")
    return _table("Controllers in contact", columns, map(row, dict.fromkeys(one.law for one in every)))


def _impedances(own):
    def row(one):
        return one.name, "coordinates" if one.law_in else "R", one.title, one.source

    columns = ("name", "acts on", "title", "source")
    return _table("Impedances", columns, map(row, known_impedances().values()))


def _metrics(own):
    alone = ((one, "arms" if one.arm_only else "all") for one in known_metrics().values())
    contact = ((one, "contact") for one in known_contact_metrics().values())
    rows = ((one.name, one.column, one.unit, of, one.title) for one, of in (*alone, *contact))
    return _table("Metrics", ("name", "column", "unit", "of", "meaning"), rows)


def _tasks(own):
    def row(one):
        plant = "each arm" if tasks.is_for_arms(one.name) else "no arm"
        return one.name, plant, one.title, one.source

    alone = map(row, map(tasks.described, tasks.names()))
    touching = map(tasks.contact_task, tasks.contact_names())
    contact = ((one.name, f"contact: {', '.join(_fitting(one))}", one.title, one.source) for one in touching)
    return _table("Tasks", ("name", "of", "title", "source"), (*alone, *contact))


def _fitting(task) -> list[str]:
    return [name for name, one in arms().items() if not isinstance(one, BadArm) and can_do(task, one)]


def _arms(own):
    return _table("Arms", ("name", "joints", "title", "source"), itertools.starmap(row_of_arm, arms().items()))


def row_of_arm(name: str, one: Arm | BadArm) -> tuple:
    """Its cells; of one that cannot be used, the reason."""
    if isinstance(one, BadArm):
        return name, "", f"cannot be used: {one}", ""
    return name, one.joints, one.title, one.source


def _variations(own):
    rows = ((name, tasks.variation(name).title) for name in tasks.variation_names())
    return _table("Variations of an arm's plant", ("name", "title"), rows)


def _axes(own):
    def row(one):
        levels = ", ".join(f"{level:g}" for level in one.levels)
        return one.name, one.unit, levels, one.title

    every = map(tasks.axis, tasks.axis_names())
    return _table("Perturbations of the free body (--axis)", ("name", "unit", "levels", "title"), map(row, every))


def _starts(own):
    rows = [
        (name, plant, tasks.start_set_size(name, of_arms), tasks.start_set_title(name, of_arms))
        for plant, of_arms in (("free body", False), ("each arm, at most", True))
        for name in tasks.start_set_names(of_arms)
    ]
    return _table("Start sets", ("name", "of", "starts", "title"), rows)


def _engines(own):
    from bench import engines

    rows = (line.split(None, 1) for line in engines.__doc__.splitlines()[2:] if line.strip())
    return _table("Engines", ("name", "what it is"), rows)


def _suites(own):
    from bench.experiments.suites import SUITES

    def row(one):
        words = len(one.on_arms.words)
        varied = ", and a study of model errors" if one.on_arms.varied else ""
        on_arms = f"{words} combinations{varied}" if words else f"every combination{varied}"
        in_contact = f"{len(one.in_contact.controllers) or 'all'} controllers"
        robustness = f"{one.robustness.starts} starts a level"
        return one.name, len({part.engine for part in one.slices}), on_arms, in_contact, robustness, one.title

    columns = ("name", "engines", "on each arm", "in contact", "robustness", "title")
    return _table("Suites", columns, map(row, SUITES.values()))


def _experiments(own):
    rows = ((one.name, f"{one.table.name}.parquet", one.title) for one in known_experiments().values())
    return _table("Experiments", ("name", "table", "title"), rows)


def _claims(own):
    from bench.findings import claims

    return _table("Claims", ("id", "section", "claim"), ((c.id, c.section, c.text) for c in claims.all_claims()))


_TABLES = {
    "regulators": _regulators,
    "representations": _representations,
    "jacobians": _jacobians,
    "inverses": _inverses,
    "controllers": _controllers,
    "impedances": _impedances,
    "metrics": _metrics,
    "tasks": _tasks,
    "arms": _arms,
    "variations": _variations,
    "axes": _axes,
    "starts": _starts,
    "engines": _engines,
    "suites": _suites,
    "experiments": _experiments,
    "claims": _claims,
}
