"""What the study of verdicts found: claims that get another word with other draws, half the step, or other gains."""

import math

from bench.experiments.tables.schema import RESULTS

STORED = RESULTS / "verdicts" / "verdicts.json"

HALF_STEP = "half-step"
"""The reference's seed, at half its control period."""


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
