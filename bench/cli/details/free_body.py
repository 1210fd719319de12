"""The free body: where each law settles, how fast, and from how many starts of each set."""

import pandas as pd
from scipy.stats import binomtest

from bench.cli.details.episodes import OF_STARTS, by_contender, places, seconds, settled

FIRST = ("law", "settled of SO(3)", "median s", "worst s")


def tables(episodes):
    """A table for each engine."""
    for place, part in places(episodes):
        yield f"{place} ({OF_STARTS}; share of SO(3) and times from uniform starts)", summary(part)


def summary(episodes):
    """One line for each law: share of SO(3) settled, settling times [s], and what settled of other start sets."""
    lines = []
    for name, own in by_contender(episodes):
        line = {"law": name}
        for start_set, part in own.groupby("start_set", observed=True, sort=True):
            if start_set == "uniform":
                line |= {"settled of SO(3)": _share(part), **seconds(part)}
            else:
                line[str(start_set)] = settled(part)
        lines.append(line)
    table = pd.DataFrame(lines)
    first = [name for name in FIRST if name in table]
    return table[first + [name for name in table if name not in first]]


def _share(part) -> str:
    """The share that settles, with its Wilson 95 % interval."""
    number = int((part["outcome"] == "settled").sum())
    low, high = binomtest(number, len(part)).proportion_ci(method="wilson")
    return f"{number / len(part):.2%} [{low:.2%}, {high:.2%}]"
