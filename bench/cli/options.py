"""Options that several commands share."""

import functools
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import rich_click as click

from bench.experiments.tables.schema import RESULTS
from bench.law.contender import Contender
from bench.law.contenders import registry
from bench.law.contenders.described_law import described
from bench.law.kinds import Law
from bench.running.schedulers import THREADS

LATEST = RESULTS / "latest"
REFERENCE = RESULTS / "reference"


def several(option: str, name: str, meaning: str, metavar: str = "NAME", **more: Any) -> Callable:
    """Return an option that may be given again and again."""
    return click.option(option, name, multiple=True, metavar=metavar, help=f"{meaning}; repeatable.", **more)


PATH = click.Path(path_type=Path)
Words: TypeAlias = tuple[str, ...]
Files: TypeAlias = tuple[Path, ...]

law = several("--law", "laws", "A file of your own with a constant REGULATOR", "FILE", type=PATH)
regulator = several(
    "--regulator",
    "regulators",
    "Only this law: NAME or NAME/REPRESENTATION; on an arm also NAME@JACOBIAN+INVERSE",
)
representation = several("--representation", "representations", "Only laws on these coordinates")
jacobian = several("--jacobian", "jacobians", "On arms, only this Jacobian")
inverse = several("--inverse", "inverses", "On arms, only this inverse")
controller = several(
    "--controller",
    "controllers",
    "In contact, only this controller, as hybrid/zyx-euler+inverse or impedance-geometric",
)
arm = several("--arm", "arms", "Only this arm")


def valued(name: str, default: Any, meaning: str, python_name: str = "", **more: Any) -> Callable:
    """Return an option that has a default, and takes values of its type unless more states one."""
    names = [name, python_name] if python_name else [name]
    facts = {"type": type(default), "show_default": True, **more}
    return click.option(*names, default=default, help=meaning, **facts)


def stacked(*options: Callable) -> Callable:
    """Return one decorator for several options."""
    return lambda command: functools.reduce(lambda made, option: option(made), reversed(options), command)


simulated = stacked(
    valued("--dt", 1e-3, "Control period in seconds.", "dt_s"),
    valued("--kp", 100.0, "Position gain [1/s^2]."),
    valued("--kv", 20.0, "Velocity gain [1/s]."),
    valued("--seed", 0, "Seed of the sampled starts."),
)
carried_out = stacked(
    valued("--workers", os.cpu_count() or 1, "Threads.", show_default="cores"),
    click.option(
        "--scheduler",
        default=THREADS,
        show_default="threads of this process",
        metavar="WORD",
        help="Who runs the episodes: local:N, so many processes here, or tcp://host:8786, a Dask cluster.",
    ),
    click.option("--replace", is_flag=True, help="Start over if the folder holds another plan."),
)


def named(regulators: Words, jacobians: Words, inverses: Words) -> dict[str, Words]:
    """Return the options with names `law@jacobian+inverse` taken apart; UsageError if they would then mean more."""
    whole = [word for word in regulators if "@" in word]
    if not whole:
        return {"regulators": regulators, "jacobians": jacobians, "inverses": inverses}
    ways = {word.partition("@")[2] for word in whole}
    [by, through] = [*sorted(ways)[0].split("+"), ""][:2]
    if len(ways) > 1 or len(whole) < len(regulators) or jacobians or inverses or not by or not through:
        raise click.UsageError(
            f"--regulator {whole[0]}: after @ comes jacobian+inverse, the same for every law and named once; name them "
            f"apart instead (try: --regulator {whole[0].partition('@')[0]} --jacobian geometric --inverse solve)"
        )
    return {"regulators": tuple(word.partition("@")[0] for word in whole), "jacobians": (by,), "inverses": (through,)}


def own_laws(files: Files) -> tuple[Law, ...]:
    """Return the regulators of these files, those that lie in bench/law/contenders too; two of one name are refused."""
    own = tuple(registry.regulator_in(file) or described(file) for file in files)
    names = [one.name for one in own]
    for name in names:
        if names.count(name) > 1:
            raise click.UsageError(f"two --law files name their regulator '{name}'; give each its own name")
    return own


def find_law(word: str) -> Law:
    """Return the law of a name, or of a user's file."""
    is_file = Path(word).suffix or Path(word).exists()
    return own_laws((Path(word),))[0] if is_file else registry.regulator(word)


def chosen(files: Files, regulators: Words, representations: Words, costings: bool = False) -> list[Contender]:
    """Return the contenders that the options name; without names, all (the user's own included)."""
    own = own_laws(files)
    if regulators:
        picked = []
        for word in regulators:
            whole = [registry.find_contender(word, own)] if "/" in word else []
            picked += whole or registry.contenders_of(registry.regulator(word, own))
        named = {one.regulator.name for one in picked}
        picked += [one for law in own if law.name not in named for one in registry.contenders_of(law)]
    else:
        picked = [one for one in registry.all_contenders(own) if costings or not one.regulator.costing_only]
    for word in representations:
        registry.representation(word)
    if representations:
        picked = [one for one in picked if one.representation and one.representation.name in representations]
        if not picked:
            raise click.UsageError(f"no chosen law acts on {', '.join(representations)} (try: bench list regulators)")
    return list(dict.fromkeys(picked))
