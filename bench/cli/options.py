"""Options that several commands share."""

import functools
import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn, TypeAlias

import rich_click as click

from bench.base.errors import BadResults
from bench.base.files import refuse_irregular
from bench.experiments.request import LONGEST_DT_S, MOST_STARTS, MOST_WORKERS, SHORTEST_DT_S
from bench.experiments.tables.schema import RESULTS
from bench.law.contender import Contender
from bench.law.contenders import registry
from bench.law.contenders.described_law import described
from bench.law.contenders.law_file import note_former_fields
from bench.law.kinds import Law
from bench.running.schedulers import THREADS

LATEST = RESULTS / "latest"
REFERENCE = RESULTS / "reference"


def several(option: str, name: str, meaning: str, metavar: str = "NAME", **more: Any) -> Callable:
    """Return an option that may be given again and again."""
    return click.option(option, name, multiple=True, metavar=metavar, help=f"{meaning}; repeatable.", **more)


PATH = click.Path(path_type=Path)


class NewFile(click.Path):
    """A file to be written: nothing is there, or a regular file. Refused before the command works for minutes."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Path:
        """Return the path; UsageError for a device, a pipe, a link or a folder."""
        path = Path(os.fsdecode(super().convert(value, param, ctx)))
        try:
            refuse_irregular(path)
        except (BadResults, ValueError) as error:
            option = param.opts[0] if param else "file"
            raise click.UsageError(f"{option} {error}", ctx) from error
        return path


NEW_FILE = NewFile(path_type=Path)


class NumberOption(click.ParamType):
    """A number within bounds. Click's own FloatRange takes NaN, which is neither below nor above any bound.

    Args:
        low: Smallest number that is allowed.
        high: Greatest number that is allowed.
        example: A usual number, which the message names as the cure.
        is_open: Whether `low` itself is refused.
        is_whole: Whether the number is an integer.
        infinite: What infinity means, such as "no bound"; where it is empty, infinity is refused.
    """

    name = "number"

    def __init__(
        self,
        low: float,
        high: float,
        example: float,
        *,
        is_open: bool = False,
        is_whole: bool = False,
        infinite: str = "",
    ):
        self.low, self.high, self.example = low, high, example
        self.is_open, self.is_whole, self.infinite = is_open, is_whole, infinite

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float | int:
        """Return the number; UsageError with what was given, what is allowed and the cure."""
        try:
            number = int(value) if self.is_whole else float(value)
        except (ValueError, TypeError):
            self._refuse(value, param, ctx)
        is_named = not isinstance(value, str) or value.strip().lower() in INFINITE
        if self.infinite and number == math.inf and is_named:
            return number
        # written so that NaN, for which every comparison is false, is refused
        is_above = number > self.low if self.is_open else number >= self.low
        if not (is_above and number <= self.high):
            self._refuse(value, param, ctx)
        return number

    def describe(self) -> str:
        """Return what is allowed, in words."""
        kind = "a whole number" if self.is_whole else "a number"
        low = f"more than {self.low:g} and" if self.is_open else f"from {_short(self.low)}"
        high = f"{'at most' if self.is_open else 'to'} {_short(self.high)}"
        return f"give {kind} {low} {high}" + (f", or inf for {self.infinite}" if self.infinite else "")

    def _refuse(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> NoReturn:
        option = param.opts[0] if param else "number"
        cure = f"(try: {option} {_short(self.example)})"
        raise click.UsageError(f"{option} '{str(value)[:SHOWN]}': {self.describe()} {cure}", ctx)


INFINITE = ("inf", "+inf", "infinity")
"""Words for infinity. 1e400 is infinite too for Python's float, but whoever writes it means another number."""

SHOWN = 40
"""Signs of a refused word that are shown."""


def _short(number: float) -> str:
    return str(number) if isinstance(number, int) else f"{number:g}"


KP = NumberOption(1e-6, 1e6, 100)
"""Position gain [1/s^2]. The time scale of a motion is 1/sqrt(kp): below 1e-6 it is more than 1000 s, the longest
horizon; above 1e6 it is shorter than the usual control period of 1 ms."""

KV = NumberOption(1e-6, 1e6, 20)
"""Velocity gain [1/s]. Bounded alike: 1/kv is the time in which a speed decays."""

PERIOD = NumberOption(SHORTEST_DT_S, LONGEST_DT_S, 0.001)
HORIZON = NumberOption(SHORTEST_DT_S, 1000.0, 10)
"""Simulated seconds; that it has at least one tick is checked with the period (request.check_numbers)."""

SEED = NumberOption(0, 2**32 - 1, 0, is_whole=True)
COUNT = NumberOption(1, MOST_STARTS, 100, is_whole=True)
WORKERS = NumberOption(1, MOST_WORKERS, os.cpu_count() or 1, is_whole=True)

LAW_LIMIT = NumberOption(0.01, 86_400.0, 30)
"""Processor time [s] for a unit of a user's law: from a hundredth, in which no process of it starts, to a day."""

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


def workers(meaning: str) -> Callable:
    """Return the option that says how many work at once."""
    return valued("--workers", os.cpu_count() or 1, meaning, type=WORKERS, show_default="cores")


simulated = stacked(
    valued("--dt", 1e-3, "Control period in seconds.", "dt_s", type=PERIOD),
    valued("--kp", 100.0, "Position gain [1/s^2].", type=KP),
    valued("--kv", 20.0, "Velocity gain [1/s].", type=KV),
    valued("--seed", 0, "Seed of the sampled starts.", type=SEED),
)
carried_out = stacked(
    workers("Threads."),
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
    for law in own:
        _note_former_fields(law.origin, law.text)
    return own


@functools.cache
def _note_former_fields(path: str, text: str) -> None:
    """Print once what a law file should write in place of former names."""
    note = note_former_fields(text)
    if note:
        click.echo(f"--law {path}: {note}", err=True)


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
        find_all = registry.all_contenders if costings else registry.simulated_contenders
        picked = find_all(own)
    for word in representations:
        registry.representation(word)
    if representations:
        picked = [one for one in picked if one.representation and one.representation.name in representations]
        if not picked:
            raise click.UsageError(f"no chosen law acts on {', '.join(representations)} (try: bench list regulators)")
    return list(dict.fromkeys(picked))
