"""The README, pasted from top to bottom: every block runs and prints something worth reading."""

import collections
import re
import subprocess

import pytest
from support.advised import is_ours
from support.command_line import bench
from support.map_rule import SPOKEN, map_rows, map_verdicts, shares_of, widest
from support.pasted_law import check_command
from support.readme import count_claims, list_conclusions, list_needs

from bench.base.provenance import ROOT
from bench.experiments.tables import store
from bench.findings.selection.regions import Rule, find_default
from bench.findings.selection.robots import ARM, decide_for
from bench.law.contenders.registry import find_contender
from tasks.situation import COORDINATES

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)
PASTED = "\n".join(text for kind, text in BLOCKS if kind == "sh").replace("\\\n", " ")
LINES = [line.partition("#")[0].split() for line in PASTED.splitlines() if line]
OURS = [words[1:] for words in LINES if words[0] == ".venv/bin/bench"]
OTHERS = [words for words in LINES if words[0] != ".venv/bin/bench"]
LAW, ERROR = (
    next(text for kind, text in BLOCKS if kind == "python" and word in text)
    for word in ("REGULATOR", "def error")
)
MOST_WORDS = 700
FEWER = {"run": ["--count", "2"]}
"""What a line that has the word gets besides here: the README's own take a minute."""


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A folder with the README's law."""
    (tmp_path / "my_law.py").write_text(LAW)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_commands_run_one_after_the_other_and_say_something(capsys, here):
    for words in OURS:
        said = bench(capsys, *words, *(one for word, more in FEWER.items() if word in words for one in more))
        lines = 0 if "export" in words else 2
        assert (said.code, len(said.out.splitlines()) > lines) == (0, True), (words, said)
        assert not re.search(r"Traceback|\b0/0\b|nothing of|\b0 episodes", said.out), (words, said)


@pytest.mark.parametrize("words", OTHERS, ids=" ".join)
def test_other_commands_are_targets_of_make(words):
    assert subprocess.run([*words, "-n"], cwd=ROOT, capture_output=True).returncode == 0


def test_plant_of_the_docs_is_driven_at_random_to_the_end_of_its_episode(capsys):
    page = (ROOT / "report/pages/docs-python.md").read_text(encoding="utf-8")
    [plant] = re.findall(r"^```python\n(.*?load\(.*?)^```", page, re.DOTALL | re.MULTILINE)
    exec(plant, {})
    assert "150" in capsys.readouterr().out  # N m, the UR5e's largest motors


def test_example_of_the_page_on_data_loads_rows_with_units(capsys, monkeypatch):
    monkeypatch.setenv("ORIENTATION_BENCH_RESULTS", str(ROOT / "results" / "reference"))
    page = (ROOT / "report/pages/appendix-data.md").read_text(encoding="utf-8")
    [example] = re.findall(r"^```python\n(.*?load\(.*?)^```", page, re.DOTALL | re.MULTILINE)
    exec(example, {})
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "s"
    assert any(line.startswith("mrp-memory ") and line.endswith(" 1.000") for line in lines), lines


def test_law_is_short_and_loses_no_start(capsys, here):
    assert LAW.count("\n") <= 15
    sets = ("--starts", "half-turn", "--starts", "poles", "--starts", "uniform", "--engine", "ideal-rk4")
    words = ("--regulator", "my-law", "--suite", "quick", "--task", "free-body", *sets, "--experiment", "free-body")
    assert bench(capsys, "run", "--law", "my_law.py", *words, "--out", "own").code == 0
    found = store.read(here / "own", "episodes")
    assert (set(found["outcome"]), (found["start_set"] == "half-turn").sum()) == ({"settled"}, 238)


def test_audit_finds_the_two_faults_of_the_example_of_the_docs(capsys, here):
    page = (ROOT / "report/pages/docs-check.md").read_text(encoding="utf-8")
    [example] = re.findall(r"^```python\n(.*?my_error.*?)^```", page, re.DOTALL | re.MULTILINE)
    (here / "my_file.py").write_text(example)
    said = bench(capsys, "audit", "my_file.py:my_error")
    assert said.code == 1
    assert "FAULTS: dead-at-180, stiffness" in said.out
    assert "slope at the goal 0.5" in said.out


def test_error_to_paste_makes_the_advised_law_over_random_states():
    shown = {}
    exec(ERROR, shown)

    def command(R, R_d, omega, q_old, kp, kv):
        error, q = shown["error"](R, R_d, q_old)
        return kp * error - kv * omega, q

    check_command(command)


def test_readme_is_short():
    words = [word for word in TEXT.split() if re.search(r"[A-Za-z]{2}|\d", word)]
    assert len(words) <= MOST_WORDS


def answer_table():
    """Return the rows of the README's table of answers: (controller, law, attribution)."""
    return re.findall(r"^\| (.+?) \| `([\w-]+)` \((\w+)\) \|", TEXT, re.MULTILINE)


def find_weak_motor_law(default):
    """Return the law that is advised in place of the default at most of the bounds of the nominal situation."""
    nominal = {name: one.nominal for name, one in COORDINATES.items()}
    laws = []
    for at, (law, *_) in map_verdicts().items():
        values = dict(zip(COORDINATES, at, strict=True))
        if law != default and {**values, "bound": nominal["bound"]} == nominal:
            laws.append(law)
    return collections.Counter(laws).most_common(1)[0][0]


def test_laws_of_the_table_are_those_that_the_map_and_the_arms_give():
    default, weak_motors, forgetful, arm = [law for _, law, _ in answer_table()]
    assert default == widest()[0][0]
    assert weak_motors == find_weak_motor_law(default)
    assert forgetful == find_default(rule=Rule(forgetful=True))
    assert arm == decide_for(ARM).law


def test_table_says_of_each_law_whose_it_is():
    for _, law, attribution in answer_table():
        assert find_contender(law).attribution == attribution


def test_tables_and_counts_are_those_of_the_committed_results():
    lines = TEXT.splitlines()
    assert not [row for row in (*list_conclusions(), *list_needs()) if row not in lines]
    assert count_claims() in " ".join(TEXT.split())


def test_shares_of_the_default_are_those_of_the_rows_and_pairs():
    """The rule is written a second time in `support.map_rule`, which reads rows and pairs alone."""
    printed = re.search(r"in (\d+) % of (\d+) random situations the law meets our requirements, and no other", TEXT)
    shares = shares_of(widest()[0][0], SPOKEN)
    unbeaten = shares["qualified"] / shares["of"]
    assert printed.groups() == (f"{100 * unbeaten:.0f}", str(shares["of"]))


def test_law_that_is_unbeaten_most_often_is_named_with_its_share():
    law, share = re.search(r"; (\S+), which must be given the command limit, does so in (\d+) %", TEXT).groups()
    laws = {name for name in map_rows()["law"] if not is_ours(name)}
    counts = {name: shares_of(name, SPOKEN)["qualified"] for name in laws}
    assert counts[law] == max(counts.values())
    assert share == f"{100 * counts[law] / shares_of(law, SPOKEN)['of']:.0f}"
