"""Read a run: the folder that `bench run` wrote, as tables whose rows are chosen by their words.

    run = Run(Path("results/reference"))
    run.table("episodes", engine="ideal-rk4", start_set=("poles", "wraps"))
    run.probe("elimination"), run.gains(), run.timings(), run.user_laws()
    run.find_contender("hybrid").short

Claims, advice, the command line and the book read runs with this class.

Every frame about contenders has a column `contender`: "regulator" or "regulator/representation", on
an arm "...@jacobian+inverse", and in contact "controller/representation+form".
"""

from __future__ import annotations

import functools
import os
from collections.abc import Mapping, Sequence, Sized
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from bench.base.errors import BadResults, NoEvidence
from bench.base.on_first_use import pd
from bench.base.provenance import read_provenance
from bench.experiments.columns import WORD
from bench.experiments.tables.kept_laws import kept_laws
from bench.experiments.tables.rows import Words, has_words, matching, number_rows, occurring, rows_where
from bench.experiments.tables.schema import RESULTS, declared_table, table_of
from bench.law.contender import Contender
from bench.law.contenders.registry import contenders, contenders_of
from bench.law.inputs import Gains
from bench.law.kinds import Law

VARIABLE = "ORIENTATION_BENCH_RESULTS"
"""The environment variable that names the folder of the run that is shown."""

TIMINGS = RESULTS / "timings"
"""Times of laws and controllers, a file a machine."""

MAIN_ENGINE = "ideal-rk4"
"""The engine that simulates in continuous time, like the paper."""

WHOLE = "run the suite 'quick', 'default' or 'full' without narrowing it"
"""The cure where a run lacks rows."""

FREE_BODY = {"jacobian": ""}
"""The words of every row about the free body, whatever the table: only an arm has a Jacobian."""

PAPERS_COORDINATES = ("", "zyx-euler")
"""The matrix itself, or Z-Y-X angles: what the paper runs its laws in."""

MARKS = {
    "controller": "",
    "regulator": "",
    "representation": "/",
    "jacobian": "@",
    "inverse": "+",
    "form": "+",
}
"""Columns that name a contender -> what stands before each word but the first."""

TIMED = (
    *("what", "engine", "arm", "regulator", "representation", "jacobian", "inverse"),
    *("ns_per_tick", "ratio", "ratio_low", "ratio_high", "ticks", "machine"),
)
"""Columns of times that are read."""

CASE = (
    *("regulator", "representation", "jacobian", "inverse", "arm"),
    *("case", "kp", "kv", "at", "outcome"),
)
"""Columns of probes.parquet that the measures of a case share."""


def shown_folder() -> Path:
    """Return the folder of the run that is shown if none is named.

    The environment variable ORIENTATION_BENCH_RESULTS can name the folder. If the variable is not
    set, the folder is results/latest if the run in this folder is finished, and results/reference
    otherwise.
    """
    named = os.environ.get(VARIABLE)
    if named:
        return Path(named).expanduser().resolve()
    finished = (RESULTS / "latest" / "provenance.json").is_file()
    return RESULTS / ("latest" if finished else "reference")


class Run:
    """The tables of one run, each read when it is first needed.

    Attributes:
        frames: Tables by name that stand in place of those of the folder; `timings` among them.
        timings_folder: Folder of the times of machines.
        others: Runs that stand in place of results/gains and results/reference; None for those.
        chosen: The rows that were read, as (table, condition); a claim clears it.
    """

    def __init__(
        self,
        folder: Path | None,
        frames: Mapping[str, pd.DataFrame] | None = None,
        timings: Path = TIMINGS,
        others: Sequence[Run] | None = None,
    ):
        self._folder = folder
        self.frames = dict(frames or {})
        self.timings_folder = timings
        self.others = others
        self.chosen: list[tuple[str, str]] = []
        self._rows: dict[tuple[str, str], pd.DataFrame] = {}
        self._probes: dict[tuple[str, str], pd.DataFrame] = {}
        self._first: pd.DataFrame | None = None

    @property
    def has_folder(self) -> bool:
        """Return whether there is more than frames."""
        return self._folder is not None

    @property
    def folder(self) -> Path:
        """Return the folder; NoEvidence: there are frames alone."""
        if self._folder is None:
            raise NoEvidence("there is no folder to read the run from; give one, or its frames")
        return self._folder

    @property
    def is_as_stored(self) -> bool:
        """Return whether all is read from the folder, and nothing stands in its place."""
        return self.has_folder and not (self.frames or self.others)

    def table(self, name: str, **words: Words) -> pd.DataFrame:
        """Return the rows of a table that have these words; there may be none.

        For example `table("episodes", engine="native", start_set=("poles", "wraps"))`. The frame is
        shared: copy it before you change it. Its columns may know words that do not occur in it.

        Errors:
            NoTable: the run has no file of the table.
            BadResults: the run has not finished, or the table has no such column.
            NoEvidence: there is neither a folder nor a frame.
        """
        condition = query_of(words)
        if (name, condition) not in self._rows:
            self._rows[name, condition] = matching(self._whole(name), words)
        rows = self._rows[name, condition]
        if len(rows):
            self.chosen.append((name, condition))
        return rows

    def _whole(self, name: str) -> pd.DataFrame:
        if name in self.frames:
            return self.frames[name]
        if self._folder is None:
            raise NoEvidence(
                f"table '{name}': there is no folder to read it from; give one, or its frame"
            )
        return read_table(self._folder, name)

    def rows(self, name: str, **words: Words) -> pd.DataFrame:
        """Return the rows of a table that have these words; NoEvidence if there are none."""
        rows = self.any_rows(name, **words)
        return require_rows(rows, f"rows of {name} with {words} in {self._folder}")

    def any_rows(self, name: str, **words: Words) -> pd.DataFrame:
        """Return the rows of a table that have these words; none if the run has no such file."""
        if name in self.frames or (self.folder / f"{name}.parquet").is_file():
            return self.table(name, **words)
        columns = [column.name for column in table_of(name).columns()]
        return pd.DataFrame(columns=[*columns, "contender"])

    def free_body(self, name: str, **words: Words) -> pd.DataFrame:
        """Return the rows of a table about the free body in the paper's coordinates."""
        return self.table(name, **words, **FREE_BODY, representation=PAPERS_COORDINATES)

    def probe(self, name: str, **words: Words) -> pd.DataFrame:
        """Return what a probe measured, a row a case and a column a measure; the frame is shared.

        NoEvidence: the run has no such rows.
        """
        rows = self.table("probes", probe=name, **words)
        require_rows(rows, f"row of the probe '{name}'")
        case = (name, query_of(words))
        if case not in self._probes:
            self._probes[case] = widen(rows)
        return self._probes[case]

    def _any_episode(self) -> pd.DataFrame:
        words = {**FREE_BODY, "engine": MAIN_ENGINE}
        if self._first is None:
            every = self._whole("episodes")
            places = has_words(every, words).nonzero()[0]
            self._first = every.iloc[places[:1]]
        if len(self._first):
            self.chosen.append(("episodes", query_of(words)))
        return require_rows(self._first, f"episode by {MAIN_ENGINE}")

    def gains(self) -> Gains:
        """Return the gains of the run's free body."""
        row = self._any_episode()
        return Gains(float(row["kp"].array[0]), float(row["kv"].array[0]))

    def period(self) -> float:
        """Return the run's control period [s]."""
        return float(self._any_episode()["dt_s"].array[0])

    def machines(self) -> list[pd.DataFrame]:
        """Return the times of each machine that was timed, its name in a column `machine`."""
        if "timings" in self.frames:
            return [self.frames["timings"]]
        paths = sorted(self.timings_folder.glob("*.parquet"))
        return [_read_times(path, path.stat().st_mtime_ns) for path in paths]

    def timings(self) -> pd.DataFrame:
        """Return times per tick of laws alone, on every machine; there may be none."""
        times = self._all_timings()
        return times[(times["what"] == "law") & (times["ticks"] > 0)]

    def controller_timings(self) -> pd.DataFrame:
        """Return times per tick of whole controllers of arms, on every machine; maybe none."""
        times = self._all_timings().reindex(columns=[*TIMED, "contender"])
        is_whole = (times["what"] == "engine") & (times["engine"] == "native")
        return times[is_whole & (times["jacobian"] != "") & (times["ticks"] > 0)]

    def _all_timings(self) -> pd.DataFrame:
        frames = self.machines()
        times = pd.concat(frames, ignore_index=True) if frames else pd.DataFrame(columns=TIMED)
        return with_contender(times)

    def provenance(self, *needed: str) -> dict[str, Any]:
        """Return the contents of provenance.json: how the results were made.

        BadResults: it is not as a run writes it, or lacks an entry that is needed.
        """
        return read_provenance(self.folder, needed)

    def user_laws(self) -> tuple[Law, ...]:
        """Return the user's laws that took part, by name; one that may not run has no function.

        Errors:
            BadResults: laws/ is a link or holds one, or a file whose name is no word.
            BadLaw: a law that may run cannot be read.
        """
        if self._folder is None or not os.path.lexists(self._folder / "laws"):
            return ()
        return kept_laws(self._folder, read_table(self._folder, "costs"))

    @functools.cached_property
    def _user_laws(self) -> dict[str, Law]:
        return {law.name: law for law in self.user_laws()}

    def is_users(self, regulator: str) -> bool:
        """Return whether a regulator came with the run, and not with the benchmark."""
        return regulator not in contenders("regulators") and regulator in self._user_laws

    def find_law(self, regulator: str) -> Law | None:
        """Return the law of a regulator's name, also a user's; None if there is none."""
        return contenders("regulators").get(regulator) or self._user_laws.get(regulator)

    def find_contender(self, name: str) -> Contender | None:
        """Return the contender of a name, as rows write it; None if there is none."""
        name = name.partition("@")[0]
        law = self.find_law(name.partition("/")[0])
        variants = contenders_of(law) if law else []
        return next((variant for variant in variants if variant.name == name), None)


@functools.cache
def run_in(folder: Path) -> Run:
    """Return one object a folder, so that what is computed from a run is computed once."""
    return Run(folder)


def shown_run() -> Run:
    """Return the run that is shown."""
    return run_in(shown_folder())


Rows = TypeVar("Rows", bound=Sized)


def require_rows(rows: Rows, what: str) -> Rows:
    """Return a frame, or another collection, if it is not empty; NoEvidence: it is."""
    if len(rows) == 0:
        raise NoEvidence(f"no {what}: {WHOLE}")
    return rows


def converged(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the episodes without those whose outcome changes if the time step is shorter."""
    return rows_where(rows, ~has_words(rows, {"converged": "no"}))


@functools.lru_cache(maxsize=16)
def _read_times(path: Path, changed_ns: int) -> pd.DataFrame:
    """Return the times of a machine; changed_ns: when the file was written, for another is read again."""
    from bench.experiments.tables.store import frame

    return frame(path, "timings").assign(machine=path.stem)


@functools.cache
def read_table(folder: Path, name: str, columns: tuple[str, ...] | None = None) -> pd.DataFrame:
    """Return a table, with `contender` if its rows belong to laws; one copy a process.

    columns: those that are read; all if None.
    """
    from bench.experiments.tables.store import read

    frame = read(folder, name, columns)
    words = {column.name for column in declared_table(name).columns() if column.type == WORD}
    words.intersection_update(columns or words)
    found = set(_columns_of_words(frame))
    # Numbers may be missing: a metric may be newer than the run.
    for column in sorted(words ^ found):
        raise BadResults(
            f"{folder}: table {name} has no column {column} as ours is; run again"
        )
    has_laws = "controller" in frame or "regulator" in frame
    return with_contender(frame) if has_laws else frame


def _columns_of_words(frame: pd.DataFrame) -> list[str]:
    kinds = frame.dtypes.items()
    return [str(column) for column, kind in kinds if isinstance(kind, pd.CategoricalDtype)]


def with_contender(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the frame with `contender` added, as the command line writes it; each combination is named only once."""
    columns = [name for name in MARKS if name in frame]
    first, number = number_rows(frame, columns)
    names = [""] * len(first)
    for column in columns:
        for place, word in enumerate(frame[column].array[first].tolist()):
            if word:
                names[place] += MARKS[column] + word
    categories = sorted(set(names))
    code_of = {name: code for code, name in enumerate(categories)}
    codes = np.array([code_of[name] for name in names], dtype=int)
    return frame.assign(contender=pd.Categorical.from_codes(codes[number], categories))


def choose_rows(frame: pd.DataFrame, words: Mapping[str, Words]) -> pd.DataFrame:
    """Return the rows with these words, renumbered from 0, with only the words that occur.

    BadResults: the frame has no such column.
    """
    rows = matching(frame, words)
    columns = {column: occurring(rows[column].array) for column in _columns_of_words(rows)}
    return rows.assign(**columns)


def query_of(words: Mapping[str, Words]) -> str:
    """Return the condition of rows with these words, as pandas.DataFrame.query takes it."""
    conditions = []
    for column, word in words.items():
        is_several = isinstance(word, tuple)
        conditions.append(f"{column} in {list(word)}" if is_several else f"{column} == {word!r}")
    return " and ".join(conditions)


def widen(rows: pd.DataFrame) -> pd.DataFrame:
    """Return rows of probes.parquet with a column a measure, a row a case, in the order of rows."""
    first, number = number_rows(rows, CASE)
    measure, names = pd.factorize(rows["measure"].array)
    columns = np.full((len(names), len(first)), np.nan)
    columns[measure, number] = rows["value"].to_numpy(float)
    cases = {name: rows[name].array[first] for name in CASE}
    return pd.DataFrame({**cases, **dict(zip(map(str, names), columns, strict=True))})
