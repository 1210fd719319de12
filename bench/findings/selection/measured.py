"""All criteria of all laws, with their intervals, and whether a law is notably better than another."""

from __future__ import annotations

import functools
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bench.findings.claims.tables import Results
from bench.findings.selection.criteria import BY_NAME, CRITERIA, Criterion
from bench.findings.selection.tables import Tables, tables_of
from bench.tables.statistics import Estimate, bootstrap, quantile


class Measured(NamedTuple):
    """values: criterion -> law -> one value a start, or one alone."""

    tables: Tables
    values: dict[str, dict[str, np.ndarray]]

    @property
    def laws(self) -> list[str]:
        """All laws, the cheapest first."""
        return list(self.tables.contenders)

    def number(self, criterion: str, law: str) -> float:
        """A criterion of a law; not a number if it was not asked."""
        values = self.values[criterion].get(law)
        return math.nan if values is None or not len(values) else float(statistic(BY_NAME[criterion])(values))

    def estimate(self, criterion: str, law: str) -> Estimate:
        """The same with its 95 % interval, that of the starts: a bootstrap. One value alone has none."""
        values = self.values[criterion].get(law, np.array([]))
        if len(values) < 2:
            return Estimate(*[self.number(criterion, law)] * 3)
        return bootstrap(values, statistic(BY_NAME[criterion]))

    def beats(self, criterion: str, law: str, other: str) -> bool:
        """Whether a law is better by a criterion, notably, and not by the chance of these starts.

        Both are asked the same starts, so what is resampled is the start, and what must not change its sign the
        difference (a paired bootstrap).
        """
        one = BY_NAME[criterion]
        own, others = (one.sense * self.number(criterion, name) for name in (law, other))
        if not own < others or (np.isfinite(others) and others - own <= one.notable * abs(others)):
            return False
        values, beside = self.values[criterion][law], self.values[criterion][other]
        if len(values) < 2 or len(values) != len(beside):
            return True
        both = np.stack([values, beside], axis=1)
        return bootstrap(both, functools.partial(_difference, one)).high < 0.0


def _difference(one: Criterion, drawn: np.ndarray, axis: int) -> np.ndarray:
    """Own less other's, in the sense of the criterion; of resamples (m, n, 2), or of the starts (n, 2)."""
    each = statistic(one)(drawn, axis=-2)
    with np.errstate(invalid="ignore"):
        return np.nan_to_num(one.sense * (each[..., 0] - each[..., 1]), nan=0.0, posinf=math.inf, neginf=-math.inf)


def statistic(one: Criterion):
    """What is made of a law's values: statistic(values, axis=-1) -> numbers."""
    if one.level is None:
        return np.mean
    return lambda values, axis=-1: quantile(values, one.level, axis)


def measure(results: Results) -> Measured:
    """All criteria of a run."""
    tables = tables_of(results)
    return Measured(tables, {one.name: one.measure(tables) for one in CRITERIA})


@functools.cache
def measured(folder: Path) -> Measured:
    """Those of the run in a folder."""
    return measure(Results(folder))
