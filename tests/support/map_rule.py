"""The rule of the map of advice (`bench.findings.selection.regions`), written a second time, on arrays."""

import collections
import functools

import numpy as np

from bench.law.contenders.registry import find_contender
from support.advised import is_ours
from support.tables import table
from tasks.situation import COORDINATES

RULE_COLUMNS = ("lost", "stuck", "unwound", "trapped")


@functools.cache
def map_verdicts():
    """Return situation -> (advised law, unbeaten published laws, unbeaten ones of ours, those that beat the first)."""
    rows, found = table("situations", "situations"), {}
    for at, own in rows.groupby([*COORDINATES]):
        asked = own[(own[[*RULE_COLUMNS]] == 0).all(axis=1) & np.isfinite(own["time"])].set_index("law")
        ours = [law for law in asked.index if is_ours(law)]
        times = asked[["time", "time_low", "time_high"]].to_numpy()
        is_beaten = (times[:, 0] < 0.99 * times[:, :1]) & (times[:, 2] < times[:, 1:2])
        beats = {law: set(asked.index[is_beaten[:, i]]) for i, law in enumerate(asked.index)}
        published = [law for law in asked.index if law not in ours]
        beaten = {law for one in published for law in beats[one]}
        kept = sorted(
            set(published) - beaten,
            key=lambda law: (len(find_contender(law).regulator.memory or ()), asked["operations"][law], law),
        )
        law = kept[0] if kept else None
        free = tuple(one for one in ours if one not in beaten) if law else tuple(ours)
        found[at] = law, frozenset(kept), free, tuple(one for one in ours if law in beats[one])
    return found


def drawn_verdicts():
    """Return the verdicts on situations that differ from the nominal one in two numbers beside the damping ratio."""
    nominal = [one.nominal for one in COORDINATES.values()][1:]
    return [one for at, one in map_verdicts().items() if sum(a != b for a, b in zip(at[1:], nominal, strict=True)) > 1]


def widest():
    """Return (law, advised share, unbeaten share) of every region, the widest first."""
    drawn = drawn_verdicts()
    count = collections.Counter(law for law, *_ in drawn if law)
    unbeaten = {law: sum(law in kept for _, kept, *_ in drawn) for law in count}
    shares = {law: (number / len(drawn), unbeaten[law] / len(drawn)) for law, number in count.items()}
    return sorted(((law, *own) for law, own in shares.items()), key=lambda one: (-one[1], one[0]))
