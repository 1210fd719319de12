"""The table of a run: its facts in words, whoever wrote them, and a command that can be pasted."""

import pytest

from report.figures.method import provenance

GIVEN = {
    "command": "bench run --suite default --replace",
    "episodes": 104108,
    "trials": 22992,
    "troubled": 54432,
    "lost": [],
    "dirty": False,
    "versions": {"numpy": "2.4.6"},
    "weather": "<b>fair</b>",
}


def find_rows(**changed):
    table = provenance.describe_run(GIVEN | changed)
    cells = [line.strip("| ").split(" | ") for line in table.splitlines()[2:]]
    return dict(cells)


def test_facts_are_in_words_and_the_command_is_code():
    rows = find_rows()
    assert rows["Command"] == "`bench run --suite default --replace`"
    assert rows["Episodes in contact"] == "22\u202f992"
    assert rows["Episodes in which a law of the user crashed or hung"] == "none"
    assert rows["Changes that were not committed"] == "no"
    assert rows["Version of numpy"] == "2.4.6"
    assert rows["weather"] == "&#60;b&#62;fair&#60;/b&#62;"


def test_all_episodes_are_the_sum_that_bench_show_prints():
    assert provenance.count_episodes(GIVEN) == 181_532
    assert provenance.count_episodes(GIVEN | {"trials": "many"}) == 181_532 - 22_992


@pytest.mark.parametrize("command", ["a `b`", "a | b", "a\nb"])
def test_command_that_would_end_its_code_is_plain_text(command):
    assert not provenance.describe_fact("command", command).startswith("`")
