"""States drawn at random, for counterexamples that Z3 does not find: near 180°, near the goal, at the edges of paths.

A state that is found so is confirmed by Z3 with its numbers fixed; that none is found proves nothing.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from sympy.polys.rings import PolyElement

from bench.findings.proofs.conditions import PolynomialRelation
from bench.findings.proofs.paths import Path
from bench.findings.proofs.trace import Symbols
from bench.law.inputs import PAPERS_GAINS

STATES = 20_000
EDGES = 1_500
"""States at the edge of each condition of a path: between two states, of which one meets it and one does not."""
HALVINGS = 45
MOST = 4
"""States that are given to Z3."""

SPHERES = ("w", "x", "y", "z"), ("a", "b", "c", "d")
"""Symbols that are a unit quaternion: of the turn, of the goal."""
LEFT_OPEN = ("x", "a")
"""The symbols whose squares are 1 minus the others': Z3 finds them itself."""
RATES = ("omega_x", "omega_y", "omega_z")

Values = dict[str, np.ndarray]


def search(
    symbols: Symbols, path: Path, conditions: tuple[PolynomialRelation, ...]
) -> Iterator[dict[str, float]]:
    """Yield up to MOST drawn states on a path that meet conditions, as well as doubles can tell."""
    draw = np.random.default_rng(7)
    every = [*path.decisions, *conditions]
    values = draw_states(symbols, draw, STATES)
    found = _meeting(symbols, path, every, values)
    if not len(found):
        values = _at_edges(symbols, path, every, values, draw)
        found = _meeting(symbols, path, every, values)
    for place in found[:MOST]:
        yield {name: float(numbers[place]) for name, numbers in values.items()}


def states_on(
    symbols: Symbols, path: Path, conditions: list[PolynomialRelation], values: Values, most: int
) -> list[dict[str, float]]:
    """Return some of the drawn states that are on a path, with the path's own symbols."""
    defined = define(symbols, path, values)
    places = np.flatnonzero(meets(symbols, conditions, defined))[:most]
    return [{name: float(numbers[place]) for name, numbers in defined.items()} for place in places]


def draw_states(symbols: Symbols, draw: np.random.Generator, count: int) -> Values:
    """Draw states: orientations, a third of them near 180° and a third near the goal; rates and gains of any size."""
    names = [name for name in symbols.of if not name.startswith(("root", "angle", "cosine", "sine"))]
    values = {name: draw.normal(size=count) for name in names}
    for sphere in SPHERES:
        if set(sphere) <= set(values):
            values |= _unit(values, sphere)
    values |= _near_the_ends(values, draw)
    sizes = 10.0 ** draw.uniform(-3.0, 2.5, size=count)
    length = np.sqrt(sum(values[name] ** 2 for name in RATES)) if set(RATES) <= set(values) else 1.0
    for name in RATES:
        if name in values:
            values[name] = values[name] / length * sizes
    is_papers = draw.random(count) < 0.5
    for name, number in PAPERS_GAINS._asdict().items():
        if name in values:
            values[name] = np.where(is_papers, number, number * 10.0 ** draw.uniform(-2.0, 2.0, size=count))
    if "size" in values:
        values["size"] = 10.0 ** draw.uniform(-2.0, 2.0, size=count)
    for factor in symbols.positive:
        values[str(factor)] = np.abs(values[str(factor)])
    return values


def _unit(values: Values, sphere: tuple[str, ...]) -> Values:
    length = np.sqrt(sum(values[name] ** 2 for name in sphere))
    return {name: values[name] / length for name in sphere}


def _near_the_ends(values: Values, draw: np.random.Generator) -> Values:
    """Return the quaternion of the turn, w nearly 0 in a third of the states, and nearly 1 or -1 in another."""
    if "w" not in values:
        return {}
    count = len(values["w"])
    kind, small = draw.integers(0, 3, size=count), 10.0 ** draw.uniform(-8.0, 0.0, size=count)
    w = np.where(kind == 0, np.sign(values["w"]) * small, values["w"])
    w = np.where(kind == 1, np.sign(values["w"]) * np.sqrt(1.0 - np.minimum(small, 1.0) ** 2), w)
    eps = np.sqrt(values["x"] ** 2 + values["y"] ** 2 + values["z"] ** 2)
    left = np.sqrt(np.maximum(0.0, 1.0 - w**2)) / eps
    return {"w": w, **{name: values[name] * left for name in ("x", "y", "z")}}


def evaluate(symbols: Symbols, polynomial: PolyElement, values: Any) -> Any:
    """Return a polynomial at states."""
    names = [str(generator) for generator in symbols.field.gens]
    total: Any = 0.0
    for powers, coefficient in polynomial.terms():
        term: Any = float(coefficient)
        for name, power in zip(names, powers, strict=True):
            if power:
                term = term * values[name] ** power
        total = total + term
    return total


def evaluate_ratio(symbols: Symbols, value: Any, values: Any) -> Any:
    """Return a traced value at states."""
    return evaluate(symbols, value.value.numer, values) / evaluate(symbols, value.value.denom, values)


def define(symbols: Symbols, path: Path, values: Values) -> Values:
    """Return states with the roots, angles, cosines and sines of a path."""
    values = dict(values)
    functions = {"root": np.sqrt, "angle": np.arctan2, "cosine": np.cos, "sine": np.sin}
    with np.errstate(all="ignore"):
        for definition in path.definitions:
            numbers = [evaluate_ratio(symbols, value, values) for value in definition.of]
            values[definition.name] = functions[definition.kind](*numbers)
    return values


def meets(symbols: Symbols, conditions: list[PolynomialRelation], values: Values) -> np.ndarray:
    """Tell for each state whether it meets all conditions."""
    count = len(next(iter(values.values())))
    holds = np.ones(count, bool)
    compare = {
        "<": np.less,
        "<=": np.less_equal,
        ">": np.greater,
        ">=": np.greater_equal,
        "=": np.equal,
        "!=": np.not_equal,
    }
    with np.errstate(all="ignore"):
        for condition in conditions:
            numbers = evaluate(symbols, condition.polynomial, values)
            holds &= np.broadcast_to(compare[condition.relation](numbers, 0.0), count)
    return holds


def _meeting(
    symbols: Symbols, path: Path, conditions: list[PolynomialRelation], values: Values
) -> np.ndarray:
    """Return the places of the states that meet all conditions."""
    return np.flatnonzero(meets(symbols, conditions, define(symbols, path, values)))


def _at_edges(
    symbols: Symbols,
    path: Path,
    conditions: list[PolynomialRelation],
    values: Values,
    draw: np.random.Generator,
) -> Values:
    """Return states near the edges of conditions: on lines between two states, found by halving."""
    parts = []
    for condition in conditions:
        inside = meets(symbols, [condition], define(symbols, path, values))
        if inside.any() and not inside.all():
            yes = _take(values, draw.choice(np.flatnonzero(inside), EDGES))
            no = _take(values, draw.choice(np.flatnonzero(~inside), EDGES))
            low, high = np.zeros(EDGES), np.ones(EDGES)
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                holds = meets(symbols, [condition], define(symbols, path, _between(symbols, yes, no, middle)))
                low, high = np.where(holds, middle, low), np.where(holds, high, middle)
            beside = low * (1.0 - 10.0 ** draw.uniform(-9.0, -1.0, size=EDGES))
            parts.append(_between(symbols, yes, no, beside))
    if not parts:
        return _take(values, np.array([], int))
    return {name: np.concatenate([part[name] for part in parts]) for name in values}


def _take(values: Values, places: np.ndarray) -> Values:
    return {name: numbers[places] for name, numbers in values.items()}


def _between(symbols: Symbols, one: Values, other: Values, share: np.ndarray) -> Values:
    """Return the states at a share of the ways from some states to others, quaternions of length 1 again."""
    values = {name: one[name] + share * (other[name] - one[name]) for name in one}
    for sphere in SPHERES:
        if set(sphere) <= set(values):
            values |= _unit(values, sphere)
    return values
