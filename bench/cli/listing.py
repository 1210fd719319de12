"""`list`: what there is to run, by kind."""

import functools
from collections.abc import Callable, Iterator, Mapping
from types import SimpleNamespace
from typing import Any, NamedTuple

import rich_click as click

import tasks
from bench.base.errors import UnknownWord
from bench.cli import options
from bench.cli.screen import console, examples, word_table
from bench.engines.metrics.registry import known_contact_metrics, known_metrics
from bench.experiments.experiment import known_experiments
from bench.experiments.suites import SUITES
from bench.law.contenders import registry
from bench.law.control.contact_controller import HYBRIDS
from bench.law.control.registry import all_controllers
from tasks.arm import arms
from tasks.condition import known_axes
from tasks.contact import can_do
from tasks.errors import BadArm
from tasks.variations import VARIATIONS


class Kind(NamedTuple):
    """A table of `list`: its title, find() -> things by name or a folder of contenders, attributes that are shown."""

    title: str
    find: Callable[[], Mapping[str, Any]] | str
    attributes: str = "title source"

    def find_all(self) -> Mapping[str, Any]:
        """Return every thing by name."""
        return registry.contenders(self.find) if isinstance(self.find, str) else self.find()

    def rows(self, own: tuple = ()) -> Iterator[tuple[str, ...]]:
        """Yield the name and the attributes of each thing, the user's own laws last."""
        for name, one in {**self.find_all(), **{one.name: one for one in own}}.items():
            paths = (attribute.split(".") for attribute in self.attributes.split())  # as `table.name`
            found = (functools.reduce(lambda part, word: getattr(part, word, ""), path, one) for path in paths)
            yield name, *map(write_cell, found)


def write_cell(value: Any) -> str:
    """Return a value as the text of a cell."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:g}"
    return ", ".join(map(write_cell, value)) if isinstance(value, list | tuple) else str(value)


def find_controllers() -> Mapping[str, Any]:
    """Return the controllers in contact: one for each law, with its coordinates and forms."""
    found: dict[str, Any] = {}
    for one in all_controllers():
        title = f"impedance: {one.impedance.title}" if one.impedance else HYBRIDS[one.law]
        law = found.setdefault(one.law, SimpleNamespace(coordinates=[], forms=[], title=title))
        for names, name in ((law.coordinates, one.representation and one.representation.name), (law.forms, one.form)):
            if name and name not in names:
                names.append(name)
    return found


def find_tasks() -> Mapping[str, Any]:
    """Return the tasks; those of contact with the arms that can do them."""
    found: dict[str, Any] = {name: tasks.described(name) for name in tasks.names()}
    for task in map(tasks.contact_task, tasks.contact_names()):
        able = [name for name, arm in arms().items() if not isinstance(arm, BadArm) and can_do(task, arm)]
        found[task.name] = SimpleNamespace(title=task.title, source=task.source, contact=able)
    return found


def describe_arm(one: Any) -> Any:
    """Return an arm; for one that cannot be used, the reason as its title."""
    return SimpleNamespace(title=f"cannot be used: {one}") if isinstance(one, BadArm) else one


def find_starts(of_arms: bool) -> Mapping[str, Any]:
    """Return the start sets with their numbers of starts."""
    every = {name: tasks.find_start_set(name, of_arms) for name in tasks.start_set_names(of_arms)}
    return {name: SimpleNamespace(starts=one.size, title=one.title) for name, one in every.items()}


def find_engines() -> Mapping[str, Any]:
    """Return the engines, from the docstring of their package."""
    from bench import engines

    lines = (line.split(None, 1) for line in engines.__doc__.splitlines()[2:] if line.strip())
    return {name: SimpleNamespace(title=title) for name, title in lines}


def find_claims() -> Mapping[str, Any]:
    """Return the claims."""
    from bench.findings import claims

    return {one.id: one for one in claims.all_claims()}


KINDS = {
    "regulators": Kind("Regulators", "regulators", "coordinates property attribution origin source"),
    "representations": Kind("Representations", "representations", "symbols source"),
    "jacobians": Kind("Jacobians", "jacobians", "takes title source"),
    "inverses": Kind("Inverses", "inverses", "gives title source"),
    "controllers": Kind("Controllers in contact", find_controllers, "coordinates forms title"),
    "impedances": Kind("Impedances", "impedances"),
    "shipped": Kind("Controllers as they are shipped", "shipped", "level title source"),
    "baselines": Kind("Baselines of arms, which are no laws", "baselines"),
    "springs": Kind("Springs of an orientation", "springs", "title source"),
    "compensators": Kind("Laws with a state", "compensators", "measures_rate property title source"),
    "metrics": Kind("Metrics", known_metrics, "unit arm_only title"),
    "contact-metrics": Kind("Metrics of contact", known_contact_metrics, "unit title"),
    "tasks": Kind("Tasks", find_tasks, "contact title source"),
    "arms": Kind("Arms", lambda: {name: describe_arm(one) for name, one in arms().items()}, "joints title source"),
    "variations": Kind("Variations of an arm's plant", lambda: VARIATIONS),
    "axes": Kind("Perturbations of the free body (--axis)", known_axes, "unit levels title"),
    "starts": Kind("Start sets of the free body", lambda: find_starts(False), "starts title"),
    "arm-starts": Kind("Start sets of arms, starts on each arm at most", lambda: find_starts(True), "starts title"),
    "engines": Kind("Engines", find_engines),
    "suites": Kind("Suites", lambda: SUITES),
    "experiments": Kind("Experiments", known_experiments, "table.name title"),
    "claims": Kind("Claims", find_claims, "section sentence"),
}


@click.command("list", epilog=examples("list"))
@click.argument("kind", required=False, metavar="[KIND]")
@options.law
def COMMAND(kind: str | None, laws: options.Files) -> None:
    """List what can be run, of one kind or of all.

    Kinds: regulators, representations, jacobians, inverses, controllers, impedances, shipped,
    springs, compensators, baselines, metrics, contact-metrics, tasks, arms, variations, axes, starts,
    arm-starts, engines, suites, experiments, claims. A file of an arm that cannot be used is listed with the reason.
    """
    own = options.own_laws(laws)
    if kind is not None and kind not in KINDS:
        plural = {"axis": "axes"}.get(kind, kind + "s")
        if plural not in KINDS:
            raise UnknownWord("kind", kind, list(KINDS))
        kind = plural
    for word in KINDS if kind is None else (kind,):
        one = KINDS[word]
        rows = list(one.rows(own if word == "regulators" else ()))
        names = ["name", *(attribute.partition(".")[0].replace("_", " ") for attribute in one.attributes.split())]
        used = [at for at, _ in enumerate(names) if any(row[at] for row in rows)]
        shown = [[row[at] for at in used] for row in rows]
        console().print(word_table([names[at] for at in used], shown, one.title))
