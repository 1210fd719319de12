"""Tables and advice from Python: `bench.load` and `bench.advise`, which import nothing before they are called."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from bench.base.errors import BadResults, Incompatible, UnknownWord
from bench.cli.advise import COMMAND, Reply, find_reply
from bench.experiments.tables.run import Run, choose_rows, shown_folder, with_contender
from bench.experiments.tables.schema import all_tables, table_of

if TYPE_CHECKING:
    import pandas as pd

ADVISED_UNITS = {
    "time_s": "s",
    "time_low_s": "s",
    "time_high_s": "s",
    "peak_rad_per_s2": "rad/s^2",
    "overshoot_deg": "deg",
}
"""Units of the columns of `Advised.table`; the others are words and counts."""


def load(table: str, folder: str | Path | None = None, **words: Any) -> pd.DataFrame:
    """Return the rows of a table of results that have the given words in the given columns.

    `frame.attrs["units"]` has the unit of each column, `frame.attrs["meanings"]` says what it is. A column `contender`
    names the law as the command line writes it.

    Args:
        table: A table's name, such as "episodes" (results/README.md lists all), or the path of a parquet file of ours.
        folder: Folder of the run; None takes results/latest if there is a finished run, and results/reference if not.
        words: A column and its word, such as engine="ideal-rk4".

    Errors:
        BadResults: there is no such file or column, or the file is none of ours.
        UnknownWord: there is no such table, or the column never has this word.
    """
    name = str(table)
    if name.endswith(".parquet"):
        frame, name = _read_file(Path(table))
    elif name in all_tables():
        where = Path(folder) if folder else shown_folder()
        frame = Run(where.resolve()).table(name)
    else:
        raise UnknownWord("table", name, sorted(all_tables()))
    for column, word in words.items():
        if column in frame and hasattr(frame[column], "cat"):
            known = [str(value) for value in frame[column].cat.categories]
            if word not in known:
                raise UnknownWord(column, str(word), known)
    rows = choose_rows(frame, words)
    columns = table_of(name).columns()
    rows.attrs = {
        "units": {column.name: column.unit for column in columns if column.name in rows},
        "meanings": {column.name: column.meaning for column in columns if column.name in rows},
    }
    return rows


def _read_file(path: Path) -> tuple[pd.DataFrame, str]:
    """Return the rows of a file, and the name of its table, which is in the file."""
    from bench.experiments.tables import store

    name = store.read_name(path)
    if name not in all_tables():
        raise BadResults(f"{path}: it is no table of ours; give a parquet file of a results folder")
    frame = store.frame(path, name)
    has_laws = {"controller", "regulator"} & set(frame.columns)
    return (with_contender(frame) if has_laws else frame), name


class Advised:
    """An answer of `bench advise`.

    Attributes:
        law: The advised law, None if none is; of an arm, that where the inertia is low.
        text: The answer in words, as the command line prints it; `print` shows it.
        table: The laws that were simulated, the fastest first, with units in `attrs`; None if none were.
        answer: All numbers behind it: `Advice`, `ArmAnswer` or `Decision` of bench.findings.selection.
    """

    def __init__(self, reply: Reply, kp: float) -> None:
        self.answer = reply.advice
        light = getattr(reply.advice, "light", None)
        self.law: str | None = getattr(light.advice if light else reply.advice, "law", None)
        lines = [f"{head}: {' '.join(sentences)}" for head, sentences in reply.paragraphs]
        self.text = "\n\n".join(lines)
        rows = getattr(reply.advice, "rows", None)
        self.table = None if rows is None else _in_units(rows, kp)

    def __repr__(self) -> str:
        return self.text


def _in_units(rows: pd.DataFrame, kp: float) -> pd.DataFrame:
    """Return rows of a situation, which are in units of kp, in seconds and rad/s^2."""
    unit_s = 1.0 / math.sqrt(kp)
    table = rows[["contender"]].astype(str)
    for name in ("time", "time_low", "time_high"):
        table[f"{name}_s"] = rows[name] * unit_s
    table["peak_rad_per_s2"] = rows["peak"] * kp
    table["overshoot_deg"] = rows["overshoot"]
    for name in ("starts", "lost", "stuck", "trapped", "operations"):
        table[name] = rows[name]
    table = table.reset_index(drop=True)
    table.attrs["units"] = ADVISED_UNITS
    return table


def advise(**options: Any) -> Advised:
    """Return which law to use, as `bench advise` answers.

    For example: `advise(kp=400, kv=28, rate=500, delay="5ms")`, or of an arm `advise(arm="panda", stiffness=50)`.

    Args:
        options: The options of `bench advise --help`, with _ in place of -; True for an option without a value.

    Errors:
        Incompatible: an option is unknown, its value is not allowed, or two do not go together.
    """
    words = []
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        if value is True:
            words.append(option)
        elif value is not False and value is not None:
            words.append(f"{option}={value}")
    try:
        context = COMMAND.make_context("advise", words)
        reply = find_reply(context)
    except click.UsageError as error:
        raise Incompatible(f"advise: {error.format_message()}") from error
    return Advised(reply, context.params["kp"])
