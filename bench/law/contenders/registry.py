"""Finding what exists: every module of a folder that holds the one named constant.

Nothing registers itself; dropping a file is enough. The file name, underscores turned to dashes, must be the
constant's name.
"""

import functools
import importlib
import pkgutil
from pathlib import Path
from typing import Any

from bench.base.errors import BadLaw, Incompatible, UnknownWord
from bench.law.compensator import Compensator
from bench.law.contender import ON_MATRIX, Contender, Regulator, Representation, contender
from bench.law.contenders import (
    baselines,
    compensators,
    impedances,
    inverses,
    jacobians,
    regulators,
    representations,
    shipped,
    springs,
)
from bench.law.impedance import Impedance
from bench.law.resolved_motion import Inverse, Jacobian
from bench.law.shipped import Shipped
from bench.law.spring import Spring


def collect(package, constant: str, kind: type) -> dict[str, Any]:
    """Word -> the constant of that name, from every module of a package, in alphabetical order.

    Errors:
        BadLaw: a module has no such constant, or its name is not the file's.
    """
    found: dict[str, Any] = {}
    for module_info in pkgutil.iter_modules(package.__path__):
        module = importlib.import_module(f"{package.__name__}.{module_info.name}")
        value: Any = getattr(module, constant, None)
        if not isinstance(value, kind):
            raise BadLaw(f"{module.__file__} has no {constant} that is a {kind.__name__}; each file there needs one")
        word, name = module_info.name.replace("_", "-"), getattr(value, "name", None)
        if name != word:
            raise BadLaw(f"{module.__file__}: {constant}.name is '{name}', but the file's name makes it '{word}'")
        found[word] = value
    return found


FOLDERS = {
    "regulator": (regulators, Regulator),
    "representation": (representations, Representation),
    "Jacobian": (jacobians, Jacobian),
    "inverse": (inverses, Inverse),
    "impedance": (impedances, Impedance),
    "baseline": (baselines, Regulator),
    "shipped": (shipped, Shipped),
    "spring": (springs, Spring),
    "compensator": (compensators, Compensator),
}
"""What is found in a folder of bench/law/contenders: constants of one type, named as their kind."""


@functools.cache
def known(kind: str) -> dict[str, Any]:
    """Word -> what there is of a kind, from its folder."""
    package, record = FOLDERS[kind]
    return collect(package, kind.upper(), record)


known_regulators = functools.partial(known, "regulator")
known_representations = functools.partial(known, "representation")
known_jacobians = functools.partial(known, "Jacobian")
known_inverses = functools.partial(known, "inverse")
known_impedances = functools.partial(known, "impedance")
known_shipped = functools.partial(known, "shipped")
known_springs = functools.partial(known, "spring")
known_compensators = functools.partial(known, "compensator")


def baselines_of_arms() -> dict[str, Contender]:
    """Word -> the controllers of arms that laws are compared with; an orientation alone they do not regulate."""
    return {name: Contender(one, None, *one.through) for name, one in known("baseline").items()}


def contenders_of(regulator: Regulator) -> list[Contender]:
    """A regulator in every representation it acts on."""
    if regulator.coordinates == ON_MATRIX:
        return [contender(regulator)]
    every = known_representations()
    words = every if regulator.coordinates == "any" else regulator.coordinates
    return [contender(regulator, representation(word)) for word in words]


def all_contenders(extra: tuple[Regulator, ...] = ()) -> list[Contender]:
    """Every regulator in every representation it acts on, costings included; then the user's own."""
    return [one for regulator in (*known_regulators().values(), *extra) for one in contenders_of(regulator)]


@functools.cache
def papers_laws() -> tuple[Contender, ...]:
    """The paper's three laws in its order and coordinates."""
    found = (one for one in all_contenders() if one.regulator.papers and not one.is_elsewhere)
    return tuple(sorted(found, key=lambda one: one.regulator.papers))


@functools.cache
def papers_coordinates() -> Representation:
    """The paper's own coordinates."""
    return next(one for one in known_representations().values() if one.papers)


def regulator(word: str, extra: tuple[Regulator, ...] = ()) -> Regulator:
    """The regulator of that name, the user's own among them."""
    return _named("regulator", word, extra)


def regulator_in(file: Path) -> Regulator | None:
    """The regulator of a file in bench/law/contenders/regulators/; None for a file elsewhere."""
    is_here = file.is_file() and file.resolve().parent == Path(regulators.__path__[0]).resolve()
    return known_regulators().get(file.stem.replace("_", "-")) if is_here else None


def representation(word: str) -> Representation:
    """The representation of that name."""
    return _named("representation", word)


def jacobian(word: str) -> Jacobian:
    """The Jacobian of that name."""
    return _named("Jacobian", word)


def inverse(word: str) -> Inverse:
    """The inverse of that name."""
    return _named("inverse", word)


def _named(kind: str, word: str, own: tuple = ()) -> Any:
    every = known(kind) | {one.name: one for one in own}
    if word not in every:
        raise UnknownWord(kind, word, sorted(every))
    return every[word]


def find_contender(word: str, extra: tuple[Regulator, ...] = ()) -> Contender:
    """`regulator[/representation][@jacobian+inverse]`, as rows and the command line write it.

    Errors:
        UnknownWord: a part that is in no list. Incompatible: no representation is named, and the regulator acts on
        several.
    """
    law, _, way = word.partition("@")
    name, _, coordinates = law.partition("/")
    if name in baselines_of_arms():
        return _by_way(baselines_of_arms()[name], way)
    chosen = regulator(name, extra)
    several = contenders_of(chosen)
    if coordinates:
        one = contender(chosen, representation(coordinates))
    elif len(several) == 1:
        one = several[0]
    else:
        choices = ", ".join(each.name for each in several)
        raise Incompatible(f"regulator '{name}' acts on several coordinates; name one: {choices}")
    return _by_way(one, way)


def _by_way(one: Contender, way: str) -> Contender:
    if one.regulator.through or not way:
        return one
    by, _, through = way.partition("+")
    return one._replace(jacobian=jacobian(by), inverse=inverse(through))
