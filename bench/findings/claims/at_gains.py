"""Claims decided more than once: at other gains, by the sampled engines too, and in the study of verdicts.

The study asks which claims get another word with other draws, half the step, or other gains.
"""

import contextlib
import functools
import math
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

STORED = RESULTS / "verdicts" / "verdicts.json"

HALF_STEP = "half-step"
"""The reference's seed, at half its control period."""


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


def turned(runs: dict[str, dict], reference: dict[str, str]) -> dict[str, dict[str, str]]:
    """Claim -> run -> its word, of the claims that get another word somewhere than on the reference."""
    found: dict[str, dict[str, str]] = {}
    for name, one in runs.items():
        for id in {*reference, *one["words"]}:
            word = one["words"].get(id, "not judged")
            if word != reference.get(id):
                found.setdefault(id, {})[name] = word
    return dict(sorted(found.items()))


def describe(study: dict, words: dict[str, str]) -> str:
    """Return what the study of seeds, of half the step and of other gains found, in a sentence or two."""
    runs = study["runs"]
    seeds = sum(name != HALF_STEP for name in runs)
    other = turned(runs, words)
    found = "every verdict stays the same" if not other else f"these change: {', '.join(other)}"
    step = " and with half the step size" if HALF_STEP in runs else ""
    return f"With {seeds} other random seeds{step}, {found}.{by_gains(study, words)}"


def by_gains(study: dict, words: dict[str, str]) -> str:
    """Which verdicts are other ones at other damping ratios; nothing where no run at other gains was judged."""
    said = []
    for one in study.get("gains", ()):
        changed = (f"{id} ({word})" for id, word in one["words"].items() if word != words[id])
        ratio = one["kv"] / (2.0 * math.sqrt(one["kp"]))
        said.append(f"with a damping ratio of {ratio:g}: {', '.join(changed) or 'none'} of {len(one['words'])}")
    return f" Other gains change these verdicts, of those that their runs decide: {'; '.join(said)}." if said else ""
