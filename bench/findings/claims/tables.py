"""What judging functions read: a run's tables, the engines that they need, shares with their intervals."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence, Sized
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables import read
from bench.experiments.tables.schema import RESULTS
from bench.findings.amounts import count_of
from bench.findings.claims.verdict import Evidence, NoEvidence
from bench.findings.start_sets import describe_lacking, least_starts
from bench.law.inputs import Gains

if TYPE_CHECKING:
    from bench.experiments.tables.statistics import Estimate
    from bench.findings.maps import Spun

MAIN_ENGINE = "ideal-rk4"
CHECK_ENGINES = ("ideal-held", "native")
SETTLED = "settled"
WHOLE = "run the suite 'quick', 'default' or 'full' without narrowing it"

PAPERS_COORDINATES = ("", "zyx-euler")
"""None, or Z-Y-X angles: what chapter 6 runs its laws in. In others they are later laws."""


TIMED = (
    *("what", "engine", "arm", "regulator", "representation", "jacobian", "inverse"),
    *("ns_per_tick", "ratio", "ratio_low", "ratio_high", "ticks", "machine"),
)


CASE = (
    *("regulator", "representation", "jacobian", "inverse", "arm"),
    *("case", "kp", "kv", "at", "outcome"),
)
"""Columns of probes.parquet that its measures of one case share."""


class Results:
    """The tables of one run, read when first asked for; `frames` puts others in their place.

    Attributes:
        others: Runs that stand in the place of results/gains and results/reference; None for those.
        is_as_stored: Whether nothing stands in another's place.
        chosen: The rows that were asked for, as (table, condition); a claim clears it.
    """

    def __init__(
        self,
        folder: Path | None,
        frames: dict | None = None,
        timings: Path = RESULTS / "timings",
        maps: Path = RESULTS / "maps",
        others: Sequence[Results] | None = None,
    ):
        self.folder = folder
        self.is_as_stored = folder is not None and not (frames or others)
        self.frames = dict(frames or {})
        self.timings_folder, self.maps_folder = timings, maps
        self.others = others
        self.chosen: list[tuple[str, str]] = []
        self._chosen: dict[tuple, pd.DataFrame] = {}
        self._first: pd.DataFrame | None = None
        self._spun: dict[tuple[str, Gains, str], list[Spun]] = {}

    def table(self, name: str, **words: str) -> pd.DataFrame:
        """Rows of one table that have these words, chosen once and shared; there may be none."""
        return self._note(name, query_of(words), self._choose(name, words))

    def probe(self, name: str, **words: str) -> pd.DataFrame:
        """Return what a probe measured, a row a case and a column a measure; NoEvidence: the run does not have it."""
        return widen(some(self.table("probes", probe=name, **words), f"row of the probe '{name}'"))

    def _note(self, name: str, condition: str, rows: pd.DataFrame) -> pd.DataFrame:
        """Keep the condition of rows that were asked for, if there are any, and return the rows."""
        if len(rows):
            self.chosen.append((name, condition))
        return rows

    def _choose(self, name: str, words: dict[str, str]) -> pd.DataFrame:
        asked = (name, *sorted(words.items()))
        if asked not in self._chosen:
            self._chosen[asked] = read.matching(self._read(name), words)
        return self._chosen[asked]

    def _read(self, name: str) -> pd.DataFrame:
        if name not in self.frames:
            if self.folder is None:
                raise NoEvidence(f"table '{name}': there is no folder to read it from; give one, or its frame")
            self.frames[name] = read.table(self.folder, name)
        return self.frames[name]

    def free_body(self, name: str, **words: str) -> pd.DataFrame:
        """Rows of one table that have these words and are about the free body, in the paper's coordinates."""
        return self._note(name, _free_body_query(words), self._choose_free_body(name, words))

    def _choose_free_body(self, name: str, words: dict[str, str]) -> pd.DataFrame:
        frame = self._choose(name, {**read.FREE_BODY, **words})
        return read.rows_where(frame, frame["representation"].isin(PAPERS_COORDINATES).to_numpy())

    def episodes(self, regulator: str, engine: str, *start_sets: str) -> pd.DataFrame:
        """Return episodes of a law on the free body from some start sets; NoEvidence: fewer than a whole suite has."""
        words = {"task": "free-body", "regulator": regulator, "engine": engine}
        frame, condition = self._choose_free_body("episodes", words), _free_body_query(words)
        if start_sets:
            frame = read.rows_where(frame, frame["start_set"].isin(start_sets).to_numpy())
            condition = f"{condition} and {query_of({'start_set': start_sets})}"
        self._note("episodes", condition, frame)
        some(frame, f"episode of {regulator} by {engine} from {', '.join(start_sets) or 'any start set'}")
        self.check_starts(frame, f"{regulator} by {engine}", least_starts(engine), *start_sets)
        return frame

    def check_starts(self, frame: pd.DataFrame, what: str, least: Mapping[str, int], *start_sets: str) -> None:
        """Refuse a run with fewer starts of a set, of those named or all, than a claim needs; not tables alone."""
        lacking = self.folder and describe_lacking(frame, least, *start_sets)
        if lacking:
            raise NoEvidence(f"{what} ran from fewer starts than the claim needs ({lacking}): {WHOLE}")

    def _any_episode(self) -> pd.DataFrame:
        words = {**read.FREE_BODY, "engine": MAIN_ENGINE}
        if self._first is None:
            every = self._read("episodes")
            self._first = every.iloc[read.has_words(every, words).nonzero()[0][:1]]
        return some(self._note("episodes", query_of(words), self._first), f"episode by {MAIN_ENGINE}")

    def gains(self) -> Gains:
        """Return the run's gains."""
        row = self._any_episode()
        return Gains(float(row["kp"].array[0]), float(row["kv"].array[0]))

    def period(self) -> float:
        """Return the run's control period [s]."""
        return float(self._any_episode()["dt_s"].array[0])

    def spun(self, law: str, engine: str = MAIN_ENGINE) -> list[Spun]:
        """Return starts of a law at stated speeds, with the run's gains, from the maps in the repository.

        There are none where no map has the law with these gains by this engine.
        """
        from bench.findings.maps import counted, list_spun, spun_in

        if not self._spun:
            given = self.frames.get("map")
            if "counted" in self.frames:
                self._spun = list_spun(self.frames["counted"])
            else:
                self._spun = spun_in(self.maps_folder) if given is None else list_spun(counted(given))
        return self._spun.get((law, self.gains(), engine), [])

    def timings(self) -> pd.DataFrame:
        """Time per tick of laws alone, on every machine that was timed, a column `machine` added; maybe empty."""
        every = self._all_timings()
        return every[(every["what"] == "law") & (every["ticks"] > 0)]

    def controller_timings(self) -> pd.DataFrame:
        """Time per tick of whole controllers of arms, on every machine that was timed; maybe empty."""
        every = self._all_timings().reindex(columns=[*TIMED, "contender"])
        compiled = (every["what"] == "engine") & (every["engine"] == "native") & (every["jacobian"] != "")
        return every[compiled & (every["ticks"] > 0)]

    def machines(self) -> list[pd.DataFrame]:
        """Return the times of each machine that was timed, its name in a column `machine`."""
        paths = sorted(self.timings_folder.glob("*.parquet"))
        return [_read_times(path, path.stat().st_mtime_ns) for path in paths]

    def _all_timings(self) -> pd.DataFrame:
        frames = self.machines() + ([self.frames["timings"]] if "timings" in self.frames else [])
        every = pd.concat(frames, ignore_index=True) if frames else pd.DataFrame(columns=TIMED)
        return read.with_contender(every)


@functools.lru_cache(maxsize=16)
def _read_times(path: Path, changed_ns: int) -> pd.DataFrame:
    """Return the times of a machine; changed_ns: when the file was last written, for another one is read again."""
    from bench.experiments.tables.store import frame

    return frame(path, "timings").assign(machine=path.stem)


Rows = TypeVar("Rows", bound=Sized)


def some(frame: Rows, what: str) -> Rows:
    """Return the frame, or a list, if it has rows; NoEvidence: it has none."""
    if len(frame) == 0:
        raise NoEvidence(f"no {what}: {WHOLE}")
    return frame


def widen(rows: pd.DataFrame) -> pd.DataFrame:
    """Return rows of probes.parquet with a column for each measure, a row a case, in the order of the rows."""
    first, number = read.number_rows(rows, CASE)
    measure, names = pd.factorize(rows["measure"])
    values = rows["value"].to_numpy(float)
    columns = np.full((len(names), len(first)), np.nan)
    columns[measure, number] = values
    found = rows[list(CASE)].iloc[first].reset_index(drop=True)
    return found.assign(**dict(zip(map(str, names), columns, strict=True)))


def query_of(words: Mapping[str, str | Sequence[str]]) -> str:
    """Return the condition of rows with a word, or one of some words, in each column, as DataFrame.query takes it."""
    conditions = []
    for column, word in words.items():
        is_one = isinstance(word, str)
        conditions.append(f"{column} == {word!r}" if is_one else f"{column} in {list(word)}")
    return " and ".join(conditions)


def _free_body_query(words: Mapping[str, str]) -> str:
    """Return the condition of rows about the free body in the paper's coordinates."""
    return query_of({**words, **read.FREE_BODY, "representation": PAPERS_COORDINATES})


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

    sure = read.converged(frame)
    return lost_between(int((~settled(sure)).sum()), len(frame) - len(sure), len(frame))


def lost_text(one: Spun) -> str:
    """Return the share lost of starts at a stated speed, with its interval, and how many do not converge."""
    apart = f" ({one.unconverged} of them do not converge)" if one.unconverged else ""
    at = f"at {one.speed:g} rad/s" if one.speed else "at rest"
    return f"{brief_interval(one.share)} of {one.starts:,} starts {at}{apart}"


def settled(frame: pd.DataFrame) -> pd.Series:
    """Whether each episode settled."""
    return frame["outcome"] == SETTLED


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
