"""Claims that are decided more than once: on the runs at other gains, and by the sampled engines too."""

import contextlib
import functools
from collections.abc import Callable
from typing import Any

from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.tables import CHECK_ENGINES, MAIN_ENGINE, Results, evidence
from bench.findings.claims.verdict import NoEvidence, Word

GAINS = RESULTS / "gains"
"""Runs of the same starts at other gains, a folder each."""

RULE = (
    "The same is decided on every run of results/gains: where they do not all give one word, it depends on the gains."
)


def other_gains(results: Results) -> list[Results]:
    """Return the runs of results/gains; none for tables alone, or for one of these runs itself."""
    folder = results.folder
    if folder is None or folder.resolve().parent == GAINS.resolve():
        return []
    return [Results(path.parent) for path in sorted(GAINS.glob("*/episodes.parquet"))]


def at_every_gain(decide: Callable) -> Callable:
    """Wrap a judging function to ask the runs at other gains too; if its word differs, it depends on the gains."""

    @functools.wraps(decide)
    def judge(results: Results) -> Any:
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


def on_every_engine(decide: Callable) -> Callable:
    """Wrap a judging function of (results, engine) to ask the main engine, then the sampled ones that have rows."""

    @functools.wraps(decide)
    def judge(results: Results) -> Any:
        word, found = decide(results, MAIN_ENGINE)
        others, rows = {}, found.rows
        for engine in CHECK_ENGINES:
            with contextlib.suppress(NoEvidence):
                others[engine], also = decide(results, engine)
                rows += also.rows
        said = "No sampled engine has rows for this."
        if others:
            said = f"Sampled engines agree ({', '.join(others)})."
        if set(others.values()) - {word}:
            said = "Sampled: " + ", ".join(f"{engine} says '{other}'" for engine, other in others.items()) + "."
        return word, found._replace(sentence=f"{found.sentence} {said}", rows=rows)

    return judge
