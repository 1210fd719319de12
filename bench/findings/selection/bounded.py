"""Compare the law for a limited command with the default: the row of the answer on weak motors."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from bench.findings.amounts import join_words
from bench.findings.selection import regions
from bench.findings.selection.regions import OVERSHOOT
from bench.findings.selection.unbeaten import SPOKEN, follow_lines
from bench.findings.selection.words import percent
from tasks.situation import NOMINAL


class Bounded(NamedTuple):
    """A law that is faster than the default where the command is limited to `low` up to `high` [kp].

    Attributes:
        law: The law.
        low: Least of the limits [kp].
        high: Greatest of the limits [kp].
        faster: Greatest share of the default's time by which the law is faster, where both settle.
        unsettled: Limits at which the default does not settle in time [kp].
        overshoot: Greatest overshoot of the law at these limits [deg].
        default_overshoot: Greatest overshoot of the default at these limits [deg].
    """

    law: str
    low: float
    high: float
    faster: float
    unsettled: tuple[float, ...]
    overshoot: float
    default_overshoot: float


def find_bounded(default: str, folder: Path) -> Bounded | None:
    """Return the law that is advised at most of the bounds where the default is beaten; only the bound changes.

    None: at every bound the default is unbeaten, or nothing is advised in its place.
    """
    line = [at for at in regions.group_map(folder) if at._replace(bound=NOMINAL.bound) == NOMINAL]
    advised = {at.bound: regions.decide_at(at, folder).law for at in line}
    shares: dict[str, dict[float, float]] = {}
    for place in follow_lines(default, folder, tie=SPOKEN)["bound"]:
        law = advised[place.value]
        for rival in place.standing.rivals:
            if rival.law == law and rival.qualified:
                shares.setdefault(law, {})[place.value] = rival.faster
    if not shares:
        return None
    law = max(shares, key=lambda name: (len(shares[name]), name))
    return _compare_at_bounds(law, default, shares[law], folder)


def _compare_at_bounds(law: str, default: str, shares: dict[float, float], folder: Path) -> Bounded:
    """Return how a law compares with the default; shares: bound -> the share by which it is faster."""
    words = [NOMINAL._replace(bound=bound).word for bound in shares]
    rows = regions.read_map(folder)
    overshoots = rows[rows["situation"].isin(words)].groupby("contender", observed=True)["overshoot"].max()
    timed = [share for share in shares.values() if share < 1.0]
    return Bounded(
        law=law,
        low=min(shares),
        high=max(shares),
        faster=max(timed, default=1.0),
        unsettled=tuple(sorted(bound for bound, share in shares.items() if share >= 1.0)),
        overshoot=float(overshoots[law]),
        default_overshoot=float(overshoots[default]),
    )


def explain_bounded(bounded: Bounded, default: str) -> str:
    """Say what the law gains where the command is limited."""
    gains = []
    if bounded.faster < 1.0:
        gains.append(f"is up to {percent(bounded.faster)} faster than {default}")
    if bounded.default_overshoot > bounded.overshoot + OVERSHOOT:
        gains.append(
            f"overshoots by at most {bounded.overshoot:.0f}° ({default}: up to "
            f"{bounded.default_overshoot:.0f}°)"
        )
    if bounded.unsettled:
        limits = join_words([f"{bound:g} kp" for bound in bounded.unsettled])
        gains.append(f"settles at {limits}, where {default} does not settle in time")
    return f"at these limits the law {join_words(gains)}"
