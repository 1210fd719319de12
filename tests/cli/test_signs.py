"""Units and signs on a screen without UTF-8: spelled in ASCII, never a question mark, measured as printed."""

import io

import pytest
from support.command_line import python

from bench.base import signs
from bench.base.provenance import ROOT
from bench.cli.screen import Screen, word_table

ASCII = {"PYTHONUTF8": "0", "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONIOENCODING": None}
"""Variables of a terminal without UTF-8."""

SOURCES = [path for room in ("bench", "tasks") for path in (ROOT / room).rglob("*") if path.suffix in (".py", ".toml")]


@pytest.mark.parametrize(
    ("text", "spelled"),
    [
        ("1/√kp", "1/sqrt(kp)"),
        ("5.30/√p s", "5.30/sqrt(p) s"),
        ("D = 2 √(K I)", "D = 2 sqrt(K I)"),
        ("20 1/s², 3 rad²/s³", "20 1/s^2, 3 rad^2/s^3"),
        ("180°, |α| > 90°", "180 deg, |alpha| > 90 deg"),
        ("10⁻⁵ ≤ δ ± 2, × 3", "10^-5 <= delta +- 2, x 3"),
        ("R_d Rᵀ, 2 tan(θ/2), Ė", "R_d R^T, 2 tan(theta/2), E_dot"),
        ("Åström, Paielli–Bach", "Astrom, Paielli-Bach"),
    ],
)
def test_sign_is_spelled(text, spelled):
    assert signs.spell(text) == spelled


def test_every_sign_of_the_sources_has_a_spelling():
    every = {sign for path in SOURCES for sign in path.read_text(encoding="utf-8") if not sign.isascii()}
    assert len(every) > 20
    assert [sign for sign in every if "?" in signs.spell(sign)] == []


def test_stream_spells_what_its_encoding_lacks_and_keeps_the_rest():
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding="latin-1")
    signs.spell_where_needed(stream)
    stream.write("1/√kp, 180°, \udcff\n")
    stream.flush()
    assert raw.getvalue().decode("latin-1") == "1/sqrt(kp), 180°, ?\n"


def test_table_is_measured_as_it_is_printed():
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding="ascii")
    Screen(file=stream, width=80).print(word_table(["time [1/√kp]", "unit"], [("7.48", "rad/s²")], "At 180°"))
    stream.flush()
    title, head, row = raw.getvalue().decode("ascii").splitlines()
    assert title == "At 180 deg"
    assert head.split("  ")[0] == "time [1/sqrt(kp)]"
    assert row.index("rad/s^2") == head.index("unit")


EVERYWHERE = [
    ("list",),
    ("advise", "--help"),
    ("audit", "check", "--help"),
    ("history", "show"),
    ("run", "--suite", "quick", "--dry-run"),
    ("show", "results/reference", "robustness"),
]


@pytest.mark.parametrize("words", EVERYWHERE)
def test_screen_without_utf8_gets_ascii_without_question_marks(words):
    shown = python("-m", "bench", *words, **ASCII)
    assert shown.isascii()
    assert "?" not in shown
