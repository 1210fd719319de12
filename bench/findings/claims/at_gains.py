"""Claims decided more than once: at other gains, by the sampled engines too, and in the study of verdicts.

The study asks which claims get another word with other draws, half the step, or other gains.
"""

import contextlib
import functools
import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from bench.base.errors import NoEvidence
from bench.experiments.tables.run import MAIN_ENGINE, Run
from bench.experiments.tables.schema import RESULTS
from bench.findings.amounts import join_words
from bench.findings.claims.tables import CHECK_ENGINES, evidence
from bench.findings.claims.verdict import Evidence, Word, verb_phrase
from bench.law.inputs import Gains

REFERENCE = RESULTS / "reference"
GAINS = RESULTS / "gains"
"""Runs of the same starts at other gains, a folder each."""

RULE = (
    "Whichever run is judged, we also judge results/reference and every run of results/gains by this "
    "criterion. If these verdicts differ, the verdict is 'depends on the gains'. We do not count gains "
    "at which the claim was not tested, and we name these gains."
)

STORED = RESULTS / "verdicts" / "verdicts.json"

HALF_STEP = "half-step"
"""The reference's seed, at half its control period."""


def other_gains(run: Run) -> list[Run]:
    """Return the runs of results/gains and results/reference; none for tables alone, unless they name some.

    They are the same whatever the run is, so that every run gives a claim one word.
    """
    if run.others is not None:
        return list(run.others)
    if not run.has_folder:
        return []
    folders = [REFERENCE, *(path.parent for path in sorted(GAINS.glob("*/episodes.parquet")))]
    own = run.folder.resolve() if run.is_as_stored else None
    return [run if folder == own else _run_of(folder) for folder in folders]


@functools.cache
def _run_of(folder: Path) -> Run:
    """Return the run in a folder, one for all claims, so that what they share is computed once."""
    return Run(folder)


def at_every_gain(decide: Callable) -> Callable:
    """Wrap a judging function to ask the runs at other gains too; if its word differs, it depends on the gains."""
    return _at_every_gain(decide, lambda words: words[0] if len(set(words)) == 1 else Word.DEPENDS)


def weakest_at_every_gain(decide: Callable) -> Callable:
    """Wrap a judging function to ask the runs at other gains too; the weakest word of all gains is the claim's."""
    return _at_every_gain(decide, lambda words: max(words, key=list(Word).index))


def _at_every_gain(decide: Callable, combine: Callable[[list[Word]], Word]) -> Callable:
    @functools.wraps(decide)
    def judge(run: Run) -> Any:
        others = other_gains(run)
        if not others:
            return decide(run)
        own = run.gains()
        found = {one.gains(): decide(one) for one in others if one.gains() != own}
        found = dict(sorted({**found, own: decide(run)}.items()))
        # What was not tested at some gains says nothing of what would come out there.
        words = [word for word, _ in found.values() if word != Word.UNTESTED]
        word = combine(words) if words else Word.UNTESTED
        told = " ".join(f"At {_told(gains)}, the verdict is '{word}'. {said}" for gains, (word, said) in found.items())
        true_at: dict[str, list[Gains]] = {}
        for gains, (_, said) in found.items():
            if said.instead:
                true_at.setdefault(said.instead, []).append(gains)
        instead = " ".join(f"At {_told_all(at)}: {text}" for text, at in true_at.items())
        rows = sum(said.rows for _, said in found.values())
        return word, evidence(
            told,
            rows,
            found[own][1].tables,
            "" if word == Word.HOLDS else instead,
            _measured(own, found),
            _numbers({gains: said for gains, (_, said) in found.items()}),
        )

    return judge


def _measured(own: Gains, found: dict[Gains, tuple[Word, Evidence]]) -> str:
    """Return what was measured at a run's own gains, and the gains at which the word is another one."""
    own_word, said = found[own]
    others: dict[Word, list[Gains]] = {}
    for gains, (word, _) in found.items():
        if word != own_word:
            others.setdefault(word, []).append(gains)
    parts = [f"At {_told(own)}: {said.measured}"]
    for word, at in others.items():
        parts.append(f"At {_told_all(at)}, the claim {verb_phrase(word, 1)}.")
    return " ".join(parts)


def _numbers(said: dict[Gains, Evidence]) -> list[tuple[str, ...]]:
    """Return the tables of all gains in one, the gains before each row; nothing where there is none."""
    tables = {gains: evidence.numbers for gains, evidence in said.items() if evidence.numbers}
    if not tables:
        return []
    heads = next(iter(tables.values()))[0]
    rows = [(_told(gains), *row) for gains, (_, *rows) in tables.items() for row in rows]
    return [("Gains", *heads), *rows]


def _told_all(at: list[Gains]) -> str:
    """Return some gains: 'Kp = 100, Kd = 14, 20 and 30'; the stiffness is said once where it is the same."""
    stiffness = at[0].kp
    if any(gains.kp != stiffness for gains in at):
        return "; ".join(map(_told, at))
    return f"Kp = {stiffness:g}, Kd = {join_words([f'{gains.kv:g}' for gains in at])}"


def _told(gains: Gains) -> str:
    return f"Kp = {gains.kp:g}, Kd = {gains.kv:g}"


def on_every_engine(decide: Callable) -> Callable:
    """Wrap a judging function of (run, engine) to ask the main engine, then the sampled ones that have rows."""

    @functools.wraps(decide)
    def judge(run: Run) -> Any:
        word, found = decide(run, MAIN_ENGINE)
        others, rows = {}, found.rows
        for engine in CHECK_ENGINES:
            with contextlib.suppress(NoEvidence):
                others[engine], also = decide(run, engine)
                rows += also.rows
        said = "We did not judge the claim for sampled control, because this run has too few such simulations."
        if others:
            said = f"Simulations with sampled control give the same verdict (engine {', '.join(others)})."
        if set(others.values()) - {word}:
            listed = ", ".join(f"'{other}' (engine {engine})" for engine, other in others.items())
            said = f"Simulations with sampled control give the verdict {listed}."
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


def describe(study: dict, words: dict[str, str], ids: Iterable[str] = ()) -> str:
    """Return what the study of seeds, of half the step and of other gains found, in a sentence or two.

    Its `stale` names the claims whose criteria have changed since: of these it says nothing. Claims of `ids` that it
    does not know are newer than it, and are named.
    """
    runs, stale = study["runs"], study.get("stale", [])
    seeds = sum(name != HALF_STEP for name in runs)
    other = {id: found for id, found in turned(runs, words).items() if id not in stale}
    found = "every verdict that was tested stays the same" if not other else f"these change: {', '.join(other)}"
    step = ", and with half the time step" if HALF_STEP in runs else ""
    lacking = _lacking(stale) + _describe_new([id for id in ids if id not in study["reference"]])
    return f"With each of {seeds} other random seeds{step}, {found}.{lacking}{by_gains(study, words)}"


def _lacking(stale: list[str]) -> str:
    """Name the claims that the study judged by a criterion which stands no more."""
    if not stale:
        return ""
    names = ", ".join(stale)
    return f" This study did not test the claims {names}, because we wrote their present criteria later."


def _describe_new(ids: list[str]) -> str:
    """Name the claims that are newer than the study."""
    if not ids:
        return ""
    return f" There are no verdicts of other runs yet on {join_words(ids)}."


def by_gains(study: dict, words: dict[str, str]) -> str:
    """Say which verdicts change at other damping ratios; nothing where no run at other gains was judged."""
    said, stale = [], study.get("stale", [])
    unchanged: dict[int, list[str]] = {}
    for one in study.get("gains", ()):
        changed = [f"{id} ({word})" for id, word in one["words"].items() if word != words[id] and id not in stale]
        ratio = one["kv"] / (2.0 * math.sqrt(one["kp"]))
        decided = len(one["words"].keys() - set(stale))
        if changed:
            said.append(
                f" {decided} verdicts were tested at a damping ratio of {ratio:g}, and these "
                f"change: {', '.join(changed)}."
            )
        else:
            unchanged.setdefault(decided, []).append(f"{ratio:g}")
    for decided, ratios in unchanged.items():
        *most, last = ratios
        shown = f"{', '.join(most)} or {last}" if most else last
        said.append(f" At a damping ratio of {shown}, none of the {decided} verdicts that were tested changes.")
    return "".join(said)
