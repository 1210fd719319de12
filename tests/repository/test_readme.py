"""The README, pasted from top to bottom: every block runs and prints something worth reading."""

import re
import subprocess

import pytest
from support.command_line import bench

from bench.provenance import ROOT
from bench.tables import store

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)
SHELL = "\n".join(text for kind, text in BLOCKS if kind == "sh").replace("\\\n", " ")
LINES = [line.partition("#")[0].split() for line in SHELL.splitlines() if line]
PYTHON = [".venv/bin/python", "-m", "bench"]
LAW, PLANT = (next(text for kind, text in BLOCKS if kind == "python" and has in text) for has in ("REGULATOR", "load("))
FEWER = {"run": ("--count", "2"), "local:2": ("--dry-run",)}
"""What a line that has the word gets besides here: the README's own take a minute."""
EMPTY = re.compile(r"Traceback|\b0/0\b|nothing of|\b0 episodes")


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A folder with the README's law."""
    (tmp_path / "my_law.py").write_text(LAW)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
def test_commands_run_one_after_the_other_and_say_something(capsys, here):
    for words in [line[len(PYTHON) :] for line in LINES if line[: len(PYTHON)] == PYTHON]:
        said = bench(capsys, *words, *(more for word, extra in FEWER.items() if word in words for more in extra))
        assert said.code == 0, (words, said)
        assert len(said.out.splitlines()) >= 3, (words, said)
        assert not EMPTY.search(said.out), (words, said)


def test_other_commands_are_targets_of_make():
    others = [line for line in LINES if line[: len(PYTHON)] != PYTHON]
    assert others
    for words in others:
        assert subprocess.run([*words, "-n"], cwd=ROOT, capture_output=True).returncode == 0, words


def test_plant_is_driven_at_random_to_the_end_of_its_episode(capsys):
    exec(PLANT, {})
    assert "150" in capsys.readouterr().out  # N m, the UR5e's largest motors


def test_law_loses_no_start_of_the_directed_sets(capsys, here):
    words = ("--law", "my_law.py", "--regulator", "my-law", "--task", "free-body", "--suite", "quick", "--out", "own")
    sets = ("--starts", "half-turn", "--starts", "poles", "--starts", "uniform", "--engine", "ideal-rk4")
    assert bench(capsys, "run", *words, *sets, "--experiment", "free-body").code == 0
    found = store.read(here / "own", "episodes")
    assert set(found["outcome"]) == {"settled"}
    assert (found["start_set"] == "half-turn").sum() == 238
