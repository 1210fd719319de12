"""The README, pasted from top to bottom: every block runs and prints something worth reading."""

import re
import subprocess

import pytest
from support.command_line import bench

from bench.base.provenance import ROOT
from bench.experiments.tables import store
from bench.findings.selection.regions import Rule, find_default
from bench.findings.selection.reset import describe_resets
from bench.findings.selection.robots import ARM, decide_for
from bench.findings.selection.unbeaten import find_bounds
from bench.findings.selection.words import describe_bounds, describe_ours, describe_price, describe_shares

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)
PASTED = "\n".join(text for kind, text in BLOCKS if kind == "sh").replace("\\\n", " ")
LINES = [line.partition("#")[0].split() for line in PASTED.splitlines() if line]
OURS = [words[1:] for words in LINES if words[0] == ".venv/bin/bench"]
OTHERS = [words for words in LINES if words[0] != ".venv/bin/bench"]
LAW, PLANT, ERROR = (
    next(text for kind, text in BLOCKS if kind == "python" and has in text)
    for has in ("REGULATOR", "load(", "my_error")
)
FAULTY = "my_error.py:my_error"
"""What the README has checked, and is found at fault."""
FEWER = {"run": ["--count", "2"]}
"""What a line that has the word gets besides here: the README's own take a minute."""


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A folder with the README's law and its faulty error."""
    (tmp_path / "my_law.py").write_text(LAW)
    (tmp_path / "my_error.py").write_text(ERROR)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_commands_run_one_after_the_other_and_say_something(capsys, here):
    for words in OURS:
        said = bench(capsys, *words, *(one for word, more in FEWER.items() if word in words for one in more))
        lines = 0 if "export" in words else 2
        assert (said.code, len(said.out.splitlines()) > lines) == (int(FAULTY in words), True), (words, said)
        assert not re.search(r"Traceback|\b0/0\b|nothing of|\b0 episodes", said.out), (words, said)


@pytest.mark.parametrize("words", OTHERS, ids=" ".join)
def test_other_commands_are_targets_of_make(words):
    assert subprocess.run([*words, "-n"], cwd=ROOT, capture_output=True).returncode == 0


def test_plant_is_driven_at_random_to_the_end_of_its_episode(capsys):
    exec(PLANT, {})
    assert "150" in capsys.readouterr().out  # N m, the UR5e's largest motors


def test_law_is_short_and_loses_no_start(capsys, here):
    assert LAW.count("\n") <= 15
    sets = ("--starts", "half-turn", "--starts", "poles", "--starts", "uniform", "--engine", "ideal-rk4")
    words = ("--regulator", "my-law", "--suite", "quick", "--task", "free-body", *sets, "--experiment", "free-body")
    assert bench(capsys, "run", "--law", "my_law.py", *words, "--out", "own").code == 0
    found = store.read(here / "own", "episodes")
    assert (set(found["outcome"]), (found["start_set"] == "half-turn").sum()) == ({"settled"}, 238)


def test_audit_says_what_the_readme_says_of_the_error(capsys, here):
    said = bench(capsys, "audit", FAULTY)
    assert "FAULTS: dead-at-180, stiffness" in said.out
    assert "slope at the goal 0.5" in said.out


def test_answer_is_the_one_that_the_map_gives():
    [answer] = re.findall(r"\*\*The answer\.\*\* (.*?)\n\n", TEXT, re.DOTALL)
    said = " ".join(answer.split())
    default = find_default()
    assert f"use `{default}`" in said.lower()
    assert f"`{find_default(rule=Rule(forgetful=True))}`" in said
    assert f"`{find_default(rule=Rule(continuous=True))}`" in said
    assert f"`{decide_for(ARM, ROOT / 'results' / 'reference').law}`" in said
    for sentences in (describe_shares(default), describe_price(default), describe_ours(), describe_resets(default)):
        assert sentences in said
    bounds = describe_bounds(find_bounds(default))
    assert f"no law that meets the requirements is more than 5 % faster at: {bounds}" in said
