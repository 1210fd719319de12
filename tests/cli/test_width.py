"""Tables on a terminal of 80 columns, and without UTF-8: no line is longer, every sign is ASCII, nothing is cut off."""

import io
import itertools

import pytest
from rich.cells import cell_len
from support.command_line import bench

from bench.base.provenance import ROOT
from bench.cli import screen
from bench.cli.screen import Screen, frame_table, word_table
from bench.regression import timings

WIDTH = 80
TIMINGS = sorted((ROOT / "results" / "timings").glob("*.parquet"))
COMMANDS = [
    ("list",),
    ("show", "results/reference", "--details"),
    ("show", "results/reference", "--outcomes"),
    ("show", "results/reference", "robustness"),
    ("count", "--regulator", "hybrid", "--regulator", "linearized-euler/zyx-euler", "--stages"),
    ("count", "--joints", "6"),
    ("history", "show"),
    ("run", "--suite", "default", "--dry-run"),
    *(
        pytest.param(words, marks=pytest.mark.slow)
        for words in (
            ("compare", "results/reference", "results/reference"),
            ("judge", "hybrid"),
            ("advise", "--kp", "400", "--kv", "28", "--bound", "30", "--delay", "5ms", "--rate", "500"),
            ("claims", "results/reference"),
        )
    ),
]


def too_long(text: str) -> list[str]:
    """Return the lines that are longer than the screen."""
    return [line for line in text.splitlines() if cell_len(line) > WIDTH]


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_command_prints_no_line_over_80_columns(capsys, monkeypatch, words):
    monkeypatch.chdir(ROOT)
    monkeypatch.setenv("COLUMNS", str(WIDTH))
    said = bench(capsys, *words)
    assert said.code in (0, 1)
    assert len(said.out.splitlines()) >= 3  # two equal runs: a line for each, and that they agree
    assert too_long(said.out) == []


def shown(table, encoding: str) -> str:
    """Return a table as a screen of 80 columns prints it."""
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding=encoding, errors="strict")
    Screen(file=stream, width=WIDTH).print(table)
    stream.flush()
    return raw.getvalue().decode(encoding)


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
@pytest.mark.parametrize("path", TIMINGS, ids=lambda path: path.stem)
def test_times_of_a_machine_fit(path, encoding):
    for arm, table in timings.tables(timings.read(path)):
        text = shown(frame_table(table, f"Time per tick on {arm}"), encoding)
        assert too_long(text) == []
        for name in table[table.columns[0]]:
            assert name.partition("@")[0] in text


def test_units_go_below_their_names_before_columns_do():
    names = ("law", *(f"quantity {number} [rad/s^2]" for number in range(4)))
    text = shown(word_table(names, [("shortest quaternion", *"1234")]), "utf-8")
    assert "do not fit" not in text
    assert too_long(text) == []
    first, second, *_ = text.splitlines()
    assert "quantity 3" in first
    assert "[rad/s^2]" in second


def test_every_cell_is_printed_however_many_columns_there_are():
    names = [f"column {number} of a wide table" for number in range(12)]
    cells = [[f"cell-{row}-{number}" for number in range(12)] for row in range(3)]
    text = shown(word_table(names, cells), "ascii")
    assert too_long(text) == []
    assert [cell for cell in itertools.chain(*cells) if cell not in text] == []


@pytest.mark.parametrize("columns", ["80", "120"])
def test_width_is_the_one_of_columns_where_no_terminal_is(monkeypatch, columns):
    monkeypatch.setenv("COLUMNS", columns)
    assert screen.console().width == int(columns)
    monkeypatch.delenv("COLUMNS")
    assert screen.console().width == screen.PIPED
