"""Finding what exists: every module of a folder that holds the one named constant, and every TOML file there.

Nothing registers itself; dropping a file is enough. The file name, underscores turned to dashes, must be the
constant's name. A folder whose contenders may be declared by TOML files has `read(path)`.
"""

import functools
import importlib
import pkgutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bench.base.errors import BadLaw, Incompatible, UnknownWord
from bench.law.attribution import SHIPPED_ATTRIBUTIONS
from bench.law.contender import Contender, contender
from bench.law.kinds import ON_MATRIX, Baseline, Coordinates, Impedance, Inverse, Jacobian, Law, Spring, Stateful
from bench.law.shipped import AsShipped

FOLDERS: dict[str, Any] = {
    "regulators": Law,
    "representations": Coordinates,
    "jacobians": Jacobian,
    "inverses": Inverse,
    "impedances": Impedance,
    "baselines": Baseline,
    "shipped": AsShipped,
    "springs": Spring,
    "compensators": Stateful,
}
"""Folder of bench/law/contenders -> the kind of its constants; a constant is named as its folder, in the singular."""


@functools.cache
def contenders(folder: str) -> dict[str, Any]:
    """Return word -> what the files of a folder hold, in alphabetical order.

    BadLaw: a file lacks its constant, is named otherwise than its constant, or does not say whose it is.
    """
    package = importlib.import_module(f"{__package__}.{folder}")
    constant, kind = folder.removesuffix("s").upper(), FOLDERS[folder]
    found = {path.stem: package.read(path) for path in Path(package.__path__[0]).glob("*.toml")}
    for module_info in pkgutil.iter_modules(package.__path__):
        module = importlib.import_module(f"{package.__name__}.{module_info.name}")
        value: Any = getattr(module, constant, None)
        if type(value) is not kind:
            raise BadLaw(f"{module.__file__} has no {constant} that is a {kind.__name__}; each file there needs one")
        word = module_info.name.replace("_", "-")
        if value.name != word:
            raise BadLaw(f"{module.__file__}: {constant}.name is '{value.name}', but the file's name makes it '{word}'")
        if value.attribution not in SHIPPED_ATTRIBUTIONS:
            raise BadLaw(
                f"{module.__file__}: {constant}.attribution is '{value.attribution}'; a file of this repository says "
                f"{', '.join(SHIPPED_ATTRIBUTIONS)} (see bench/law/attribution.py)"
            )
        found[module_info.name] = value
    return {name.replace("_", "-"): value for name, value in sorted(found.items())}


def baselines_of_arms() -> dict[str, Contender]:
    """Word -> the controllers of arms that laws are compared with; an orientation alone they do not regulate."""
    found = {}
    for name, baseline in contenders("baselines").items():
        by, solver = baseline.resolution or (None, None)
        found[name] = Contender(baseline.law, None, by, solver, baseline)
    return found


def contenders_of(regulator: Law) -> list[Contender]:
    """Return a regulator in every representation it acts on."""
    if regulator.coordinates == ON_MATRIX:
        return [contender(regulator)]
    every = contenders("representations")
    words = every if regulator.coordinates == "any" else regulator.coordinates
    return [contender(regulator, representation(word)) for word in words]


def all_contenders(extra: tuple[Law, ...] = ()) -> list[Contender]:
    """Every regulator in every representation it acts on, costings included; then the user's own."""
    return [one for regulator in (*contenders("regulators").values(), *extra) for one in contenders_of(regulator)]


def simulated_contenders(extra: tuple[Law, ...] = ()) -> list[Contender]:
    """Return all contenders but those whose operations alone are counted."""
    return [one for one in all_contenders(extra) if not one.regulator.costing_only]


PAPERS_LAWS = ("rotation-matrix", "linearized-euler", "feedback-linearized")
"""The paper's three laws in its order (Murphy 1988, 2.3)."""


@functools.cache
def papers_laws() -> tuple[Contender, ...]:
    """Return the paper's three laws in its order and coordinates."""
    found = [
        one
        for one in all_contenders()
        if one.regulator.name in PAPERS_LAWS and not one.uses_nonpaper_coordinates
    ]
    return tuple(sorted(found, key=lambda one: PAPERS_LAWS.index(one.regulator.name)))


@functools.cache
def papers_coordinates() -> Coordinates:
    """Return the paper's own coordinates."""
    return next(one for one in contenders("representations").values() if one.is_in_paper)


def regulator_in(file: Path) -> Law | None:
    """Return the regulator of a file in bench/law/contenders/regulators/; None for a file elsewhere."""
    is_here = file.is_file() and file.resolve().parent == Path(__file__).resolve().with_name("regulators")
    return contenders("regulators").get(file.stem.replace("_", "-")) if is_here else None


def _named(kind: str, word: str, own: tuple = ()) -> Any:
    every = contenders(f"{kind.lower()}s") | {one.name: one for one in own}
    if word not in every:
        raise UnknownWord(kind, word, sorted(every))
    return every[word]


regulator: Callable[..., Law] = functools.partial(_named, "regulator")
representation: Callable[[str], Coordinates] = functools.partial(_named, "representation")
jacobian: Callable[[str], Jacobian] = functools.partial(_named, "Jacobian")
inverse: Callable[[str], Inverse] = functools.partial(_named, "inverse")
"""Each returns the contender of a name, a user's own laws among regulators, or raises UnknownWord."""


def find_contender(word: str, extra: tuple[Law, ...] = ()) -> Contender:
    """Return `regulator[/representation][@jacobian+inverse]`, as rows and the command line write it.

    UnknownWord: a part that is in no list. Incompatible: no representation is named, and the regulator acts on several.
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
    if not way or (one.baseline is not None and one.baseline.resolution):
        return one
    by, _, solver = way.partition("+")
    return one._replace(jacobian=jacobian(by), inverse=inverse(solver))
