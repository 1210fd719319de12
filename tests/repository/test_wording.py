"""The rules for counts and column heads find what they are made for, pass what reads well, and hold for our prose."""

import re
import tomllib

import pytest
from support.rendered import fill, list_blocks, plain
from support.wording import find_counts_not_in_words, find_head_faults, find_numbers_without_noun

from bench.base.provenance import ROOT
from bench.findings.amounts import capitalize, count, count_of

PROSE = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")]
BOOK = [ROOT / "report/index.md", *sorted((ROOT / "report/pages").glob("*.md"))]
FINDINGS = sorted((ROOT / "bench/findings").glob("*.toml"))


def list_strings(value):
    """Return every text of a parsed file."""
    if isinstance(value, str):
        return [value]
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return [text for part in parts for text in list_strings(part)]


@pytest.mark.parametrize(
    "planted",
    [
        "Late braking settles first; 0 of 14 published laws do as well.",
        "The peg was not inserted in 0 of the 24 simulations.",
        "The theory is right for 96 of 96 pairs.",
        "23 of the 23 laws settle.",
        "It was 1\u202f000 of 1\u202f000 starts.",
        "One step takes 80 operations, of which 1 is a square root.",
    ],
)
def test_zero_and_all_as_numbers_are_found(planted):
    assert len(find_counts_not_in_words(planted)) == 1


@pytest.mark.parametrize(
    "sound",
    [
        "10 of 14 published laws do as well, and none of the 29 others.",
        "All 96 pairs agree; 24 of 240 do not, nor do 2.40 of 40.",
        "The first 100 of 1000 starts settle, as do 20 of 200 moves.",
    ],
)
def test_counts_in_words_pass(sound):
    assert not find_counts_not_in_words(sound)


@pytest.mark.parametrize(
    "planted",
    [
        "The controller fails in 35. It needs more torque in others.",
        "It fails, or needs more than 10 times the torque, in 65.",
        "The theory is right for 96; the rest is open.",
        "They leave it from all 24",
    ],
)
def test_number_without_its_noun_is_found(planted):
    assert len(find_numbers_without_noun(planted)) == 1


@pytest.mark.parametrize(
    "sound",
    [
        "The controller fails in 35 of the 96 moves.",
        "Robots differ, as the paper says in 1988. The laws are those of chapter 7; see Table 12.",
        "They use the vector part without a factor of 2. All angles are at most 0.5.",
    ],
)
def test_number_with_its_noun_passes(sound):
    assert not find_numbers_without_noun(sound)


def test_heads_that_need_their_neighbours_or_our_private_words_are_found():
    unsound = ["Held", "A tick", "99 %", "its time [s]", "Felt [%]", "predicted from these [1/s]"]
    assert find_head_faults([*unsound, "Law", "Time for 99 % of starts [s]", "*K*"]) == unsound


def test_counts_are_words_for_none_and_all_and_take_their_noun():
    assert [count(number, "law") for number in (0, 1, 1200)] == ["no law", "1 law", "1,200 laws"]
    assert count(2, "body", "bodies") == "2 bodies"
    assert count_of(0, 14, "laws") == "none of the 14 laws"
    assert count_of(3, 14, "laws") == "3 of the 14 laws"
    assert count_of(14, 14, "laws") == "all 14 laws"
    assert count_of(0, 0, "laws") == "no laws"
    assert capitalize(count_of(1, 2, "MRP laws")) == "1 of the 2 MRP laws"
    assert capitalize(count_of(2, 2, "MRP laws")) == "Both MRP laws"
    for part in (-1, 15):
        with pytest.raises(ValueError, match="is no part of them"):
            count_of(part, 14, "laws")


def test_values_stand_in_a_page_s_sentences_captions_and_nowhere_in_its_code():
    page = (
        "---\nkernelspec: {name: python3}\n---\n\n# Title\n\nIt is right\nfor {glue:text}`n`.\n\n- One\n- Two\n\n"
        "```{code-cell} python\n0 of 14\n```\n\n````{table} All of *it*.\n:name: tab-a\n\n```{glue:md} rows\n"
        ":format: myst\n```\n````\n\n```{glue:figure} curve\n:name: fig-a\n\nIts caption.\n```\n"
    )
    blocks = [(kind, plain(fill(words, {"n": 96}))) for kind, words in list_blocks(page)]
    assert [pair for pair in blocks if pair[0] != "code"] == [
        ("text", "# Title"),
        ("text", "It is right for 96."),
        ("text", "- One"),
        ("text", "- Two"),
        ("caption", "All of it."),
        ("pasted", "rows"),
        ("pasted", "curve"),
        ("caption", "Its caption."),
    ]


@pytest.mark.parametrize("path", [*PROSE, *BOOK], ids=lambda path: path.stem)
def test_prose_says_no_count_as_a_number_of_zero_or_all(path):
    for kind, words in list_blocks(path.read_text(encoding="utf-8")):
        assert kind == "code" or not find_counts_not_in_words(plain(words))


@pytest.mark.parametrize("path", FINDINGS, ids=lambda path: path.stem)
def test_texts_of_findings_say_no_count_as_a_number_of_zero_or_all(path):
    texts = list_strings(tomllib.loads(path.read_text(encoding="utf-8")))
    assert texts
    assert not [fault for text in texts for fault in find_counts_not_in_words(text)]


@pytest.mark.parametrize("path", BOOK, ids=lambda path: path.stem)
def test_caption_that_holds_code_or_a_value_is_fenced_with_tildes(path):
    """CommonMark takes no backtick in the line that opens a fence of backticks: the caption would be plain text."""
    assert not re.findall(r"^`{3,}\{.*`", path.read_text(encoding="utf-8"), re.MULTILINE)
