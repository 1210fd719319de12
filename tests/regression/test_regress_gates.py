"""From revisions to a comparison: what is left out and why, and what a summary makes of it. Nothing is run or timed."""

import contextlib
import subprocess

import pytest
from support.user_law import DAMPER, law_text

from bench.cli import main
from bench.errors import BadLaw, BadResults
from bench.findings.judgement import Judgement, Said
from bench.regression.revisions import comparison, gates, summary
from bench.regression.revisions.process import SideFailed

LAW = law_text(DAMPER, name="braking")
AS_NOBODY = ("-c", "user.name=nobody", "-c", "user.email=nobody@example.org", "-c", "commit.gpgsign=false")


@pytest.fixture
def user(tmp_path):
    """A user's repository: a first commit without a law, a second with one. The law's file."""
    folder = tmp_path / "user"
    subprocess.run(["git", "init", "-q", "-b", "main", folder], check=True)
    for text in ("", LAW):
        (folder / ("law.py" if text else "README")).write_text(text)
        subprocess.run(["git", "-C", folder, "add", "."], check=True)
        subprocess.run(["git", *AS_NOBODY, "-C", folder, "commit", "-qm", "more"], check=True)
    return folder / "law.py"


@pytest.fixture
def failing(finished):
    """failing(place): every side's run is one and the same; the process of the side named cannot be compiled."""

    def at(place):
        @contextlib.contextmanager
        def running(asked):
            raise SideFailed(place, "no bench.timing yet")
            yield

        return gates.Means(lambda side, report: contextlib.nullcontext(finished), running, judged=lambda laws: [])

    return at


def test_base_that_is_too_old_leaves_the_last_gates_out_and_says_why(user, failing):
    said = gates.of_revisions("HEAD", None, (user,), by=failing(0))
    assert [(one.gate, one.state) for one in said.gates] == [
        ("exact", "passed"),
        ("operations", "passed"),
        ("faults", "passed"),
        ("instructions", "skipped"),
        ("time", "skipped"),
    ]
    assert said.gates[-1].says == "base is too old for it: no bench.timing yet"
    assert said.findings == ()
    assert said.base.commit == said.head.commit


def test_law_that_cannot_be_compiled_is_a_regression(user, failing):
    said = gates.of_revisions("HEAD", None, (user,), by=failing(1))
    assert [(one.gate, one.state) for one in said.gates][3:] == [("instructions", "failed"), ("time", "skipped")]
    assert [one.says for one in said.regressions] == ["the law cannot be timed: no bench.timing yet"]


def test_law_that_base_lacks_is_new_and_one_that_head_lacks_a_mistake(user, failing):
    by = failing(0)._replace(
        running=lambda asked: contextlib.nullcontext(list(asked)),
        measured=lambda processes, *rest: ([], [], [len(processes)]),
    )
    said = gates.of_revisions("HEAD~1", None, (user,), by=by)
    assert said.gates[0].says == "the law is new: there is nothing to compare it with"
    assert said.benchmarks == (1,)
    with pytest.raises(BadResults, match="none of the --law files is there"):
        gates.of_revisions("HEAD", "HEAD~1", (user,), by=by)


def test_law_that_base_cannot_load_is_judged_as_new(user, failing):
    user.write_text("REGULATOR = None\n")
    subprocess.run(["git", *AS_NOBODY, "-C", user.parent, "commit", "-qam", "broken"], check=True)
    user.write_text(LAW)
    by = failing(0)._replace(
        running=lambda asked: contextlib.nullcontext(list(asked)),
        measured=lambda processes, *rest: ([], [], [len(processes)]),
    )
    said = gates.of_revisions("HEAD", None, (user,), by=by)
    assert said.gates[0].says.startswith("base's does not load (--law law.py: it has no REGULATOR;")
    assert said.benchmarks == (1,)


@pytest.mark.parametrize(
    ("faults", "verdicts", "state"),
    [
        ({"HEAD": (), "head": ("chatter",)}, ["regression"], "failed"),
        ({"HEAD": ("chatter",), "head": ("chatter",)}, [], "passed"),
        ({"HEAD": ("chatter",), "head": ()}, ["improvement"], "passed"),
    ],
)
def test_fault_that_base_has_not_is_a_regression(user, failing, faults, verdicts, state):
    user.write_text(LAW + "# another\n")

    def judged(laws):
        said = faults["head" if str(laws[0].origin) == str(user) else "HEAD"]
        return [Judgement("braking", tuple(Said("It shakes.", "30-method", fault) for fault in said), (), False)]

    comparison = gates.of_revisions("HEAD", None, (user,), by=failing(0)._replace(judged=judged))
    assert [one.verdict for one in comparison.findings if one.gate == "faults"] == verdicts
    assert [one.state for one in comparison.gates if one.gate == "faults"] == [state]
    assert ("- It shakes. (30-method)" in summary.markdown(comparison)) == bool(faults["head"])


def test_law_that_cannot_be_judged_is_a_regression(user, failing):
    def judged(laws):
        raise BadLaw("it cannot be compiled")

    said = gates.of_revisions("HEAD", None, (user,), by=failing(0)._replace(judged=judged))
    assert [(one.gate, one.says) for one in said.regressions] == [("faults", "it cannot be compiled")]


def test_runs_of_two_schemas_are_a_regression_and_no_mistake(user, failing, finished):
    (finished / "robustness.parquet").unlink()
    said = gates.of_revisions("HEAD", None, (user,), by=failing(0))
    [found] = said.regressions
    assert found.what == "schema"
    assert "robustness.parquet" in found.says


def test_command_writes_json_and_adds_to_the_summaries(finished, tmp_path, monkeypatch, capsys):
    job = tmp_path / "job.md"
    job.write_text("before\n")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(job))
    files = {name: tmp_path / name for name in ("said.json", "own.md")}
    words = ["compare", finished, finished, "--json", files["said.json"], "--summary", files["own.md"]]
    assert main([str(word) for word in words]) == 0
    assert "agrees with" in capsys.readouterr().out
    assert job.read_text() == "before\n" + files["own.md"].read_text()
    said = comparison.read(files["said.json"])
    assert files["own.md"].read_text().startswith("### no regression: ")
    assert [one.state for one in said.gates] == ["passed", "passed"]


def test_summary_says_why_nothing_was_judged(tmp_path, capsys):
    words = ["compare", str(tmp_path), str(tmp_path), "--summary", str(tmp_path / "own.md")]
    assert main(words) == 2
    said = capsys.readouterr().err.removeprefix("error: ")
    assert (tmp_path / "own.md").read_text().replace("\\`", "`") == f"### Not judged: {said}"


def test_markdown_leaves_no_markup_of_what_it_quotes(finished):
    said = gates.of_folders(finished, finished)
    found = comparison.Finding("exact", "regression", "a", "b", "1", "2", "a|b <img src=x> `c` *d*")
    text = summary.markdown(said._replace(findings=(found,)))
    assert "- **regression**: a\\|b &lt;img src=x&gt; \\`c\\` \\*d\\*" in text
    assert text.startswith("### 1 regression: ")
