"""Claims whose word could be another one at other gains, decided on every run of results/gains too."""

from __future__ import annotations

import functools
from collections.abc import Callable

from bench.findings.claims.tables import Results, evidence
from bench.findings.claims.verdict import Word
from bench.tables.schema import RESULTS

GAINS = RESULTS / "gains"
"""Runs of the same starts at other gains, a folder each."""

RULE = (
    "The same is decided on every run of results/gains: where they do not all give one word, it depends on the gains."
)


def other_gains(results: Results) -> list[Results]:
    """The runs of results/gains; none for tables alone, or for one of these runs itself."""
    folder = results.folder
    if folder is None or folder.resolve().parent == GAINS.resolve():
        return []
    return [Results(path.parent) for path in sorted(GAINS.glob("*/episodes.parquet"))]


def at_every_gain(decide: Callable) -> Callable:
    """A judging function of results asked of the runs at other gains too: its word depends on them if they differ."""

    @functools.wraps(decide)
    def judge(results: Results):
        others = results.found_by(other_gains, results)
        if not others:
            return decide(results)
        found = {one.gains(): decide(one) for one in (results, *others)}
        words = [word for word, _ in found.values()]
        told = " ".join(f"At Kp = {kp:g}, Kv = {kv:g}: {word}. {said}" for (kp, kv), (word, said) in found.items())
        tables = found[results.gains()][1].tables
        word = words[0] if len(set(words)) == 1 else Word.DEPENDS
        return word, evidence(told, sum(said.rows for _, said in found.values()), tables)

    return judge
