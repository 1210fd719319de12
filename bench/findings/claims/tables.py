"""What judging functions make of rows: those with enough starts, shares and times with intervals.

    episodes_of(run, law, engine, *start_sets)  rows of a law on the free body
    settled(rows)                               whether each episode settled
    settling_times(rows)                        times [s], infinite where an episode did not settle
    share(facts)                                share of yes-or-no rows that are yes, with its interval
    lost(rows)                                  share of starts that do not settle, with its interval
    same_starts(frames)                         episodes of several laws from the starts all have
    percent, percent_interval, interval         numbers as sentences write them
    evidence(sentence, rows, measured=...)      what a judging function returns beside its word

Quantiles and their intervals are in `bench.experiments.tables.statistics`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bench.base.errors import NoEvidence
from bench.base.on_first_use import pd
from bench.experiments.tables.rows import has_words
from bench.experiments.tables.run import (
    FREE_BODY,
    MAIN_ENGINE,
    PAPERS_COORDINATES,
    WHOLE,
    Run,
    converged,
    require_rows,
)
from bench.experiments.tables.schema import RESULTS
from bench.findings.amounts import count_of
from bench.findings.claims.verdict import Evidence
from bench.findings.start_sets import describe_lacking, least_starts

if TYPE_CHECKING:
    from bench.experiments.tables.statistics import Estimate
    from bench.findings.maps import Spun

CHECK_ENGINES = ("ideal-held", "native")
SETTLED = "settled"


def episodes_of(run: Run, regulator: str, engine: str, *start_sets: str) -> pd.DataFrame:
    """Return episodes of a law on the free body, in the paper's coordinates, from some start sets.

    NoEvidence: there are fewer than a whole suite has.
    """
    words: dict[str, str | tuple[str, ...]] = {
        "task": "free-body",
        "regulator": regulator,
        "engine": engine,
        **FREE_BODY,
        "representation": PAPERS_COORDINATES,
    }
    if start_sets:
        words["start_set"] = start_sets
    named = ", ".join(start_sets) or "any start set"
    rows = run.table("episodes", **words)
    require_rows(rows, f"episode of {regulator} by {engine} from {named}")
    check_starts(run, rows, f"{regulator} by {engine}", least_starts(engine), *start_sets)
    return rows


def check_starts(
    run: Run,
    rows: pd.DataFrame,
    what: str,
    least: Mapping[str, int],
    *start_sets: str,
) -> None:
    """Refuse a run with fewer starts of a set than a claim needs; frames alone may have fewer.

    start_sets: those that are counted; all of `least` if none is named.
    """
    lacking = run.has_folder and describe_lacking(rows, least, *start_sets)
    if lacking:
        raise NoEvidence(
            f"{what} ran from fewer starts than the claim needs ({lacking}): {WHOLE}"
        )


def starts_at_speed(run: Run, law: str, engine: str = MAIN_ENGINE) -> list[Spun]:
    """Return starts of a law at stated speeds, with the run's gains, from the maps of results/maps.

    There are none where no map has the law with these gains by this engine.
    """
    from bench.findings.maps import counted, list_spun, spun_in

    if "counted" in run.frames:
        spun = list_spun(run.frames["counted"])
    elif "map" in run.frames:
        spun = list_spun(counted(run.frames["map"]))
    else:
        spun = spun_in(RESULTS / "maps")
    return spun.get((law, run.gains(), engine), [])


WHOLE_PERCENT = 100.0
INTERVAL = "95 % interval: "


def percent(value: float) -> str:
    """Return a share as a number of per cent without its sign: '93.1', '6.46', '0.058', '0' and '100'."""
    number = WHOLE_PERCENT * value
    if number in (0.0, WHOLE_PERCENT):
        return f"{number:.0f}"
    if number < 1.0:
        return f"{number:.2g}"
    # What is not quite all does not become 100: 99.97 keeps its second place.
    is_nearly_all = WHOLE_PERCENT - 0.05 <= number < WHOLE_PERCENT
    return f"{number:.2f}" if number < 10.0 or is_nearly_all else f"{number:.1f}"


def percent_interval(estimate: Share | Estimate) -> str:
    """Return a share with its interval, as prose: '93.1 % (95 % interval: 91.4 to 94.5 %)'."""
    return brief_interval(estimate).replace("(", f"({INTERVAL}")


def brief_interval(estimate: Share | Estimate) -> str:
    """Return the same where a head or a sentence says what the brackets are: '93.1 % (91.4 to 94.5 %)'."""
    value, low, high = (percent(share) for share in (estimate.value, estimate.low, estimate.high))
    return f"{value} % ({low} to {high} %)"


class Share(NamedTuple):
    """k of n, with the Wilson 95 % interval of the share."""

    k: int
    n: int
    value: float
    low: float
    high: float

    def __format__(self, _: Any) -> str:
        return percent_interval(self).replace("(", f"(n = {self.n:,}; ")


def share(facts: pd.Series) -> Share:
    """Return how many of some yes-or-no rows are yes; NoEvidence: there are no rows."""
    from bench.experiments.tables.statistics import wilson

    k, n = int(facts.sum()), len(facts)
    if n == 0:
        raise NoEvidence("a share of no rows at all")
    return Share(k, n, k / n, *wilson(k, n))


def interval(one: Share | Estimate, form: str) -> str:
    """Format a number with its interval: '0.62 (95 % interval: 0.60 to 0.64)'."""
    return f"{one.value:{form}} ({INTERVAL}{one.low:{form}} to {one.high:{form}})"


NEVER = "never"


def interval_or_never(one: Estimate, form: str, unit: str = "") -> str:
    """Return a time, or a ratio of times, with its interval: '1.68 s (1.56 to 1.93)'; 'never' where it is infinite."""
    if not np.isfinite(one.value):
        return NEVER
    high = f"{one.high:{form}}" if np.isfinite(one.high) else NEVER
    return f"{one.value:{form}}{unit} ({one.low:{form}} to {high})"


def named_interval(one: Estimate, form: str, unit: str = "") -> str:
    """Return the same as prose: '1.68 s (95 % interval: 1.56 to 1.93 s)'."""
    return interval_or_never(one, form, unit).replace("(", f"({INTERVAL}").replace(")", f"{unit})")


def lost(frame: pd.DataFrame) -> Estimate:
    """Return the share of converging episodes that do not settle; the interval is that of `maps.lost_between`."""
    from bench.findings.maps import lost_between

    sure = converged(frame)
    return lost_between(int((~settled(sure)).sum()), len(frame) - len(sure), len(frame))


def lost_text(one: Spun) -> str:
    """Return the share lost of starts at a stated speed, with its interval, and how many do not converge."""
    apart = f" ({one.unconverged} of them do not converge)" if one.unconverged else ""
    at = f"at {one.speed:g} rad/s" if one.speed else "at rest"
    return f"{brief_interval(one.share)} of {one.starts:,} starts {at}{apart}"


def settled(frame: pd.DataFrame) -> pd.Series:
    """Return whether each episode settled."""
    return pd.Series(has_words(frame, {"outcome": SETTLED}), frame.index)


def settling_times(frame: pd.DataFrame) -> np.ndarray:
    """Return the settling time of each episode [s], infinite where it does not settle."""
    return frame["settling_time_s"].where(settled(frame), np.inf).to_numpy(float)


def same_starts(frames: list[pd.DataFrame]) -> list[pd.DataFrame]:
    """Return the episodes of each frame from the starts that all frames have, in the same order."""
    common = set.intersection(*(set(one["start_id"]) for one in frames))
    return [one[one["start_id"].isin(common)].sort_values("start_id", kind="stable") for one in frames]


def settled_of(frame: pd.DataFrame, noun: str) -> str:
    """Return how many of some episodes settled: '3 of 12 starts', 'all 12 starts'."""
    return count_of(int(settled(frame).sum()), len(frame), noun)


def rounding(value: float) -> str:
    """Return what rounding leaves, to one figure: '4e-16', and '0' of nothing."""
    return f"{value:.0e}" if value else "0"


def evidence(
    sentence: str,
    rows: int,
    tables: tuple[str, ...] = (),
    instead: str = "",
    measured: str = "",
    numbers: Sequence[Sequence[str]] = (),
) -> Evidence:
    """Evidence whose sentences may be broken into lines as the file likes."""
    sentence, instead, measured = (" ".join(text.split()) for text in (sentence, instead, measured))
    return Evidence(sentence, int(rows), tables, instead, measured, tuple(map(tuple, numbers)))
