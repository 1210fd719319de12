"""The rule of the map of advice (`bench.findings.selection.regions`), written a second time, on arrays."""

import collections
import functools
import math

import numpy as np

from bench.law.contenders.registry import find_contender
from support.advised import is_ours
from support.tables import table
from tasks.situation import COORDINATES

RULE_COLUMNS = ("lost", "stuck", "unwound", "trapped")
NOTABLE = SPOKEN = 0.05
OVERSHOOT = 5.0


@functools.cache
def map_rows(folder="situations"):
    """Return the rows of a map with the word of their situation, and whether the law has what is required."""
    rows = table("situations", folder)
    words = ["_".join(f"{value:g}" for value in values) for values in rows[[*COORDINATES]].to_numpy()]
    rows = rows.assign(word=words, qualified=(rows[[*RULE_COLUMNS]] == 0).all(axis=1) & np.isfinite(rows["time"]))
    published = rows[rows["qualified"] & ~rows["law"].map(is_ours)]
    least = rows["word"].map(published.groupby("word")["overshoot"].min())
    # a situation without such a law has no least overshoot, and there nobody overshoots
    return rows.assign(qualified=rows["qualified"] & ~(rows["overshoot"] > least + OVERSHOOT))


@functools.cache
def slower_pairs(notable, folder="situations"):
    """Return the set of (word, slower law, faster law) that differ by more than a share, and not by chance."""
    pairs = table("pairs", folder)
    ratio, low, high = (pairs[name].to_numpy(float) for name in ("log_ratio", "low", "high"))
    longer, shorter = -math.log(1.0 - notable), math.log(1.0 - notable)
    own = pairs.loc[(ratio > longer) & (low > 0.0), ["situation", "law", "other"]]
    other = pairs.loc[(ratio < shorter) & (high < 0.0), ["situation", "other", "law"]]
    return {*map(tuple, own.to_numpy(object)), *map(tuple, other.to_numpy(object))}


@functools.cache
def map_verdicts(folder="situations"):
    """Return situation -> (advised law, unbeaten published laws, unbeaten ones of ours, those that beat the first)."""
    slower, found, rows = slower_pairs(NOTABLE, folder), {}, map_rows(folder)
    memories = {law: len(find_contender(law).regulator.memory or ()) for law in rows["law"].unique()}
    published_laws = {law for law in memories if not is_ours(law)}
    places = rows.groupby(["word", *COORDINATES]).indices
    laws, qualified, operations = (rows[name].to_numpy() for name in ("law", "qualified", "operations"))
    for (word, *at), own in places.items():
        asked = {laws[row]: operations[row] for row in own if qualified[row]}
        beats = {law: {other for other in asked if (word, other, law) in slower} for law in asked}
        published = [law for law in asked if law in published_laws]
        ours = [law for law in asked if law not in published_laws]
        beaten = {law for one in published for law in beats[one]}
        kept = sorted(set(published) - beaten, key=lambda law: (memories[law], asked[law], law))
        law = kept[0] if kept else None
        free = tuple(one for one in ours if one not in beaten) if law else tuple(ours)
        found[tuple(at)] = law, frozenset(kept), free, tuple(one for one in ours if law in beats[one])
    return found


def is_of_draw(at):
    """Tell whether a situation differs from the nominal one in two numbers beside the damping ratio."""
    nominal = [one.nominal for one in COORDINATES.values()][1:]
    return sum(a != b for a, b in zip(at[1:], nominal, strict=True)) > 1


def drawn_verdicts():
    """Return the verdicts on the drawn situations."""
    return [one for at, one in map_verdicts().items() if is_of_draw(at)]


def widest():
    """Return (law, advised share, unbeaten share) of every region, the widest first."""
    drawn = drawn_verdicts()
    count = collections.Counter(law for law, *_ in drawn if law)
    unbeaten = {law: sum(law in kept for _, kept, *_ in drawn) for law in count}
    shares = {law: (number / len(drawn), unbeaten[law] / len(drawn)) for law, number in count.items()}
    return sorted(((law, *own) for law, own in shares.items()), key=lambda one: (-one[1], one[0]))


@functools.cache
def shares_of(law, notable):
    """Return counts of drawn situations: unbeaten among the qualified, among all, failing, losing, and how many."""
    rows = map_rows()
    rows = rows[[is_of_draw(at) for at in rows[[*COORDINATES]].itertuples(index=False, name=None)]]
    slower = slower_pairs(notable)
    counts = collections.Counter()
    for word, own in rows.groupby("word"):
        own = own.set_index("law")
        faster = [other for other in own.index if not is_ours(other) and (word, law, other) in slower]
        meets = own["qualified"][law]
        counts["qualified"] += meets and not any(own["qualified"][other] for other in faster)
        counts["all"] += meets and not faster
        counts["failing"] += not meets
        counts["losing"] += own["lost"][law] > 0
        counts["of"] += 1
    return dict(counts)
