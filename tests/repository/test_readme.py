"""The README, pasted from top to bottom: every block runs and prints something worth reading."""

import re
import subprocess

import pytest
from support.command_line import bench
from support.map_rule import NOTABLE, SPOKEN, shares_of, widest

from bench.base.provenance import ROOT
from bench.experiments.tables import store
from bench.findings.selection.regions import Rule, find_default
from bench.findings.selection.robots import ARM, decide_for
from bench.findings.selection.unbeaten import find_bounds
from bench.findings.selection.words import describe_bounds, describe_ours, describe_price, describe_shares
from bench.law.contenders.registry import find_contender

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


def answer_table():
    """Return the rows of the README's table of answers: (controller, law, attribution)."""
    return re.findall(r"^\| (.+?) \| `([\w-]+)` \((\w+)\) \|", TEXT, re.MULTILINE)


def test_laws_of_the_table_are_those_that_the_map_and_the_arms_give():
    default, weak_motors, forgetful, continuous, arm = [law for _, law, _ in answer_table()]
    assert default == widest()[0][0]
    assert weak_motors == widest()[1][0]
    assert forgetful == find_default(rule=Rule(forgetful=True))
    assert continuous == find_default(rule=Rule(continuous=True))
    assert arm == decide_for(ARM).law


def test_table_says_of_each_law_whose_it_is():
    for _, law, attribution in answer_table():
        assert find_contender(law).attribution == attribution


@pytest.mark.parametrize("describe", [describe_shares, describe_price, lambda law: describe_ours()])
def test_sentences_on_the_default_are_those_of_the_map(describe):
    assert describe(widest()[0][0]) in " ".join(TEXT.split())


def test_bounds_are_those_of_the_map():
    assert describe_bounds(find_bounds(widest()[0][0])) in " ".join(TEXT.split())


def test_shares_of_the_default_are_those_of_the_rows_and_pairs():
    """The rule is written a second time in `support.map_rule`, which reads rows and pairs alone."""
    said = re.search(
        r"In (\d+) % of (\d+) situations .*? the share is (\d+) %;"
        r".*?If 1 % counts as faster: (\d+) % and (\d+) %.\) In (\d+) % of the situations the law itself loses",
        " ".join(TEXT.split()),
    )
    law = widest()[0][0]
    spoken, close = shares_of(law, SPOKEN), shares_of(law, NOTABLE)
    counts = spoken["qualified"], spoken["all"], close["qualified"], close["all"], spoken["losing"]
    qualified, everything, *others = [f"{100 * count / spoken['of']:.0f}" for count in counts]
    assert said.groups() == (qualified, str(spoken["of"]), everything, *others)
