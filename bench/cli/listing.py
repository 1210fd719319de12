"""`list`: what there is to run, by kind."""

import itertools
from collections.abc import Callable

import rich_click as click

import tasks
from bench.cli import options
from bench.cli.screen import Frame, console, examples, word_table
from bench.contenders.registry import (
    baselines_of_arms,
    known_compensators,
    known_dampings,
    known_impedances,
    known_inverses,
    known_jacobians,
    known_limiters,
    known_pose_springs,
    known_regulators,
    known_representations,
    known_shipped,
    known_springs,
)
from bench.control.contact_controller import HYBRIDS
from bench.control.registry import all_controllers
from bench.errors import UnknownWord
from bench.experiments.contact import can_do
from bench.experiments.experiment import known_experiments
from bench.law.contender import Regulator
from bench.metrics.registry import known_contact_metrics, known_metrics
from tasks.arm import arms
from tasks.arm_model import Arm
from tasks.base import BadArm

KINDS: dict[str, Callable[[tuple[Regulator, ...]], Frame]] = {}
"""Word -> the table of that kind, of the user's own laws too."""


def kind(word: str, title: str, *columns: str):
    """Makes the function below, own laws -> rows, the table of a kind."""

    def listed(rows):
        def table(own):
            return word_table(columns, rows(own), title)

        KINDS[word] = table
        return rows

    return listed


@click.command(
    "list",
    epilog=examples(("All there is", "list"), ("One kind, a law of yours too", "list regulators --law my_law.py")),
)
@click.argument("kind", required=False, metavar="[KIND]")
@options.law
def COMMAND(kind, laws):
    """What there is to run, of one kind or of all.

    Kinds: regulators, representations, jacobians, inverses, controllers, impedances, dampings, limiters, shipped,
    springs, pose-springs, compensators, baselines, metrics, tasks, arms, variations, axes, starts, engines, suites,
    experiments, claims. A file of an arm that cannot be used is listed with the reason.
    """
    own = options.own_laws(laws)
    if kind is not None and kind not in KINDS:
        plural = {"axis": "axes"}.get(kind, kind + "s")
        if plural not in KINDS:
            raise UnknownWord("kind", kind, list(KINDS))
        kind = plural
    for one in KINDS if kind is None else (kind,):
        console().print(KINDS[one](own))


@kind("regulators", "Regulators", "name", "acts on", "proved", "source")
def _regulators(own):
    for one in dict.fromkeys((*known_regulators().values(), *own)):
        on = one.coordinates if isinstance(one.coordinates, str) else ", ".join(one.coordinates)
        yield one.name, on, "costing only" if one.costing_only else one.property, one.origin or one.source


@kind("representations", "Representations", "name", "coordinates", "source")
def _representations(_):
    return ((one.name, ", ".join(one.symbols), one.source) for one in known_representations().values())


@kind("jacobians", "Jacobians", "name", "takes", "title", "source")
def _jacobians(_):
    return ((one.name, one.takes.replace("-", " "), one.title, one.source) for one in known_jacobians().values())


SHAPES = ((6, 6), (6, 7), (7, 6), (7, 7))
"""Rows and columns of a Jacobian: three of position, with three coordinates of orientation or four; six joints or
seven."""


@kind("inverses", "Inverses", "name", "gives", "Jacobians it takes", "title", "source")
def _inverses(_):
    for one in known_inverses().values():
        shapes = ", ".join(f"{rows} x {n}" for rows, n in SHAPES if not one.refuses(rows, n))
        yield one.name, one.gives, shapes, one.title, one.source


@kind("controllers", "Controllers in contact", "name", "/coordinates", "+form", "what it is")
def _controllers(_):
    every = all_controllers()
    titles = {**HYBRIDS, **{one.law: f"impedance: {one.impedance.title}" for one in every if one.impedance}}
    for law in dict.fromkeys(one.law for one in every):
        some = [one for one in every if one.law == law]
        along = dict.fromkeys(one.representation.name for one in some if one.representation)
        forms = dict.fromkeys(one.form for one in some if one.form)
        yield law, ", ".join(along), ", ".join(forms), titles[law]


@kind("impedances", "Impedances", "name", "acts on", "title", "source")
def _impedances(_):
    every = known_impedances().values()
    return ((one.name, "coordinates" if one.law_in else "R", one.title, one.source) for one in every)


@kind("shipped", "Controllers as they are shipped", "name", "level", "title", "source")
def _shipped(_):
    return ((one.name, one.level, one.title, one.source) for one in known_shipped().values())


@kind("baselines", "Baselines of arms, which are no laws", "name", "title", "source")
def _baselines(_):
    return ((name, one.regulator.title, one.regulator.source) for name, one in baselines_of_arms().items())


@kind("dampings", "Dampings of impedances without inertia shaping", "name", "title", "source")
def _dampings(_):
    return ((one.name, one.title, one.source) for one in known_dampings().values())


@kind("limiters", "Limiters of velocity commands", "name", "title", "source")
def _limiters(_):
    return ((one.name, one.title, one.source) for one in known_limiters().values())


@kind("springs", "Rotational springs with a stiffness matrix", "name", "potential", "title", "source")
def _springs(_):
    return ((one.name, "yes" if one.potential else "no", one.title, one.source) for one in known_springs().values())


@kind("pose-springs", "Springs of position and orientation", "name", "potential", "title", "source")
def _pose_springs(_):
    return (
        (one.name, "yes" if one.potential else "no", one.title, one.source) for one in known_pose_springs().values()
    )


@kind("compensators", "Laws with a state of their own", "name", "reads the rate", "proved", "title", "source")
def _compensators(_):
    for one in known_compensators().values():
        yield one.name, "yes" if one.measures_rate else "no", one.property, one.title, one.source


@kind("metrics", "Metrics", "column", "unit", "of", "meaning")
def _metrics(_):
    alone = ((one, "arms" if one.arm_only else "all") for one in known_metrics().values())
    contact = ((one, "contact") for one in known_contact_metrics().values())
    return ((one.column, one.unit, of, one.title) for one, of in (*alone, *contact))


@kind("tasks", "Tasks", "name", "of", "title", "source")
def _tasks(_):
    for one in map(tasks.described, tasks.names()):
        yield one.name, "each arm" if tasks.is_for_arms(one.name) else "no arm", one.title, one.source
    for task in map(tasks.contact_task, tasks.contact_names()):
        fitting = [name for name, arm in arms().items() if not isinstance(arm, BadArm) and can_do(task, arm)]
        yield task.name, f"contact: {', '.join(fitting)}", task.title, task.source


@kind("arms", "Arms", "name", "joints", "title", "source")
def _arms(_):
    return itertools.starmap(row_of_arm, arms().items())


def row_of_arm(name: str, one: Arm | BadArm) -> tuple:
    """Its cells; of one that cannot be used, the reason."""
    if isinstance(one, BadArm):
        return name, "", f"cannot be used: {one}", ""
    return name, one.joints, one.title, one.source


@kind("variations", "Variations of an arm's plant", "name", "title")
def _variations(_):
    return ((name, tasks.variation(name).title) for name in tasks.variation_names())


@kind("axes", "Perturbations of the free body (--axis)", "name", "unit", "levels", "title")
def _axes(_):
    every = map(tasks.axis, tasks.axis_names())
    return ((one.name, one.unit, ", ".join(f"{level:g}" for level in one.levels), one.title) for one in every)


@kind("starts", "Start sets", "name", "of", "starts", "title")
def _starts(_):
    for plant, of_arms in (("free body", False), ("each arm, at most", True)):
        for name in tasks.start_set_names(of_arms):
            yield name, plant, tasks.start_set_size(name, of_arms), tasks.start_set_title(name, of_arms)


@kind("engines", "Engines", "name", "what it is")
def _engines(_):
    from bench import engines

    return (line.split(None, 1) for line in engines.__doc__.splitlines()[2:] if line.strip())


@kind("suites", "Suites", "name", "engines", "on each arm", "in contact", "robustness", "title")
def _suites(_):
    from bench.experiments.suites import SUITES

    for one in SUITES.values():
        words = len(one.on_arms.words)
        varied = ", and a study of model errors" if one.on_arms.varied else ""
        on_arms = f"{words} combinations{varied}" if words else f"every combination{varied}"
        in_contact = f"{len(one.in_contact.controllers) or 'all'} controllers"
        robustness = f"{one.robustness.starts} starts a level"
        yield one.name, len({part.engine for part in one.slices}), on_arms, in_contact, robustness, one.title


@kind("experiments", "Experiments", "name", "table", "title")
def _experiments(_):
    return ((one.name, f"{one.table.name}.parquet", one.title) for one in known_experiments().values())


@kind("claims", "Claims", "id", "section", "claim")
def _claims(_):
    from bench.findings import claims

    return ((one.id, one.section, one.sentence) for one in claims.all_claims())
