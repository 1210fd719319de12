"""The situation of the map that is nearest to a user's, and the numbers of a user that the map does not cover."""

from __future__ import annotations

import collections
import functools
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.findings.selection.pairs import read_pairs
from bench.findings.selection.regions import (
    NEIGHBOURS,
    RULE,
    STUDY,
    Rule,
    RuleVerdict,
    decide,
    decide_at,
    read_map,
)
from tasks.situation import COORDINATES, Situation, read_situation


class Outside(NamedTuple):
    """A number of a situation that lies outside the map: its name, its value, and the range that was run."""

    name: str
    value: float
    low: float
    high: float


def find_outside(at: Situation) -> tuple[Outside, ...]:
    """Return the numbers of a situation that are outside the map; a bound above all others is as good as none."""
    outside = []
    for (name, coordinate), value in zip(COORDINATES.items(), at, strict=True):
        low, high = min(coordinate.levels), max(coordinate.levels)
        if not low <= value <= high:
            outside.append(Outside(name, value, low, high))
    return tuple(outside)


class MapAnswer(NamedTuple):
    """What the map says of a user's situation: the nearest that was run, its verdict and rows, and how sure it is.

    distance: of the scaled numbers; 0: this very situation was run. agree: of the nearest other situations, those in
    which nothing beats the advised law, and of how many. laws: advised there, or not beaten in the nearest ones.
    """

    at: Situation
    verdict: RuleVerdict
    rows: pd.DataFrame
    distance: float
    agree: tuple[int, int]
    laws: tuple[str, ...]


def decide_nearest(
    wanted: Situation, rule: Rule = RULE, folder: Path = STUDY
) -> tuple[Situation, RuleVerdict]:
    """Return the situation of the map that is nearest to the user's, and its verdict; no other one is decided."""
    rows = read_map(folder)
    situations, places = _list_places(folder)
    nearest = situations[int(np.argmin(np.linalg.norm(places - np.array(wanted.scaled()), axis=1)))]
    pairs = read_pairs(folder).get(nearest.word)
    return nearest, decide(rows[rows["situation"] == nearest.word], rule, pairs)


@functools.cache
def _list_places(folder: Path) -> tuple[list[Situation], np.ndarray]:
    """Return the situations of a map, and the place of each among the extreme levels."""
    situations = [read_situation(str(word)) for word in read_map(folder)["situation"].unique()]
    return situations, np.array([at.scaled() for at in situations])


def answer(wanted: Situation, rule: Rule = RULE, folder: Path = STUDY) -> MapAnswer:
    """Return the verdict on the situation of the map that is nearest to the user's."""
    situations, places = _list_places(folder)
    away = np.linalg.norm(places - np.array(wanted.scaled()), axis=1)
    order = np.argsort(away, kind="stable")
    nearest = situations[order[0]]
    # Only these are decided: to decide the whole map takes seconds.
    verdict = decide_at(nearest, folder, rule)
    law = verdict.law
    beside = [decide_at(situations[place], folder, rule) for place in order[1 : NEIGHBOURS + 1]]
    agreeing = sum(law in neighbour.unbeaten for neighbour in beside)
    unbeaten: collections.Counter[str] = collections.Counter()
    for each in (verdict, *beside):
        unbeaten.update(each.unbeaten)
    laws = [name for name, _ in unbeaten.most_common() if name != law]
    rows = read_map(folder)
    return MapAnswer(
        nearest,
        verdict,
        rows[rows["situation"] == nearest.word],
        float(away[order[0]]),
        (agreeing, len(beside)),
        (law, *laws) if law else tuple(laws),
    )
