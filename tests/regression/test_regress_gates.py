"""From revisions to a comparison: what is left out and why, and the summary. Nothing is run or timed."""

import contextlib
import subprocess

import pytest
from support.user_law import DAMPER, law_text

from bench.base.errors import BadLaw, BadResults, Incompatible, UnknownWord
from bench.cli import main
from bench.findings.judgement import Judgement, Sentence
from bench.findings.subjects import SentenceSubject
from bench.regression.revisions import gates, summary
from bench.regression.revisions.commits import (
    check_out,
    find_commit,
    find_default_base,
    find_repository,
    git,
    is_folder,
)
from bench.regression.revisions.summary import Finding
from bench.regression.revisions.times import Timed
from bench.regression.timer import Side, SideFailed

LAW = law_text(DAMPER, name="braking")
SAME = Timed("braking", 1.0, 0.9, 1.1, 0.5, 6, "same")


def commit(folder, file, text):
    """Commit a file; return the commit's name."""
    (folder / file).write_text(text)
    git(folder, "add", ".")
    git(folder, "-c", "user.name=nobody", "-c", "user.email=nobody@example.org", "commit", "-qm", "more")
    return git(folder, "rev-parse", "HEAD")


@pytest.fixture
def user(tmp_path):
    """A user's repository: a first commit without a law, a second with one. The law's file."""
    folder = tmp_path / "user"
    subprocess.run(["git", "init", "-q", "-b", "main", folder], check=True)
    commit(folder, "README", "")
    commit(folder, "law.py", LAW)
    return folder / "law.py"


@pytest.fixture
def means(finished):
    """means(...): both sides' runs are one and the same; times and faults are as given."""

    def make(time=SAME, faults=(), base_faults=()):
        def compare_times(base, head, report, rounds):
            if isinstance(time, Exception):
                raise time
            return [{}, {}], {time.name: time}

        def judge(laws):
            if isinstance(faults, Exception):
                raise faults
            is_head = laws[0].origin.endswith("user/law.py")
            named = faults if is_head else base_faults
            said = tuple(Sentence("It shakes.", SentenceSubject.JUDGE, fault) for fault in named)
            return [Judgement("braking", said, (), False)]

        return gates.GateFunctions(
            lambda side, report: contextlib.nullcontext(finished), compare_times, judge
        )

    return make


def states(said):
    return {one.gate: one.state for one in said.gates}


def test_gates_of_a_law_that_is_as_before_all_pass(user, means):
    said = gates.compare_revisions("HEAD", None, (user,), functions=means())
    assert states(said) == dict.fromkeys(("exact", "operations", "faults", "time"), "passed")
    assert (said.findings, said.head) == ([], "working tree")
    assert "| braking | 1.000 \\[0.900, 1.100\\] | 0.5 | same |" in summary.write_markdown(said)


@pytest.mark.parametrize(("head", "state"), [("main", "passed"), ("working tree", "skipped")])
def test_equal_sources_are_timed_only_if_a_commit_is_compared_with_itself(tmp_path, means, head, state):
    base = Side(tmp_path, name="main", digest="1")
    comparison = summary.Comparison("main", head)
    gates._compare_times(comparison, base, base._replace(name=head), print, means())
    assert states(comparison) == {"time": state}


def test_law_that_is_slower_twice_is_a_regression(user, means):
    slower = Timed("braking", 1.3, 1.2, 1.4, 1e-9, 60, "slower", True)
    said = gates.compare_revisions("HEAD", None, (user,), functions=means(slower))
    assert [one.says[:51] for one in said.regressions] == ["braking is slower: a tick takes 1.30 times as long "]
    assert states(said)["time"] == "failed"


@pytest.mark.parametrize(
    ("at", "state", "says"),
    [(0, "skipped", "base is too old for it: no timing"), (1, "failed", "the law cannot be timed: no timing")],
)
def test_side_that_cannot_be_timed_is_skipped_as_base_and_a_regression_as_head(user, means, at, state, says):
    said = gates.compare_revisions(
        "HEAD", None, (user,), functions=means(SideFailed(at, "no timing"))
    )
    assert (said.gates[-1].state, said.gates[-1].says) == (state, says)
    assert len(said.regressions) == at


def test_law_that_base_lacks_is_judged_alone_and_one_that_head_lacks_is_a_mistake(user, means):
    said = gates.compare_revisions("HEAD~1", None, (user,), functions=means(faults=("chatter",)))
    assert states(said) == {"exact": "skipped", "operations": "skipped", "faults": "failed", "time": "skipped"}
    with pytest.raises(BadResults, match="none of the --law files is there"):
        gates.compare_revisions("HEAD", "HEAD~1", (user,), functions=means())


def test_law_that_base_cannot_load_is_judged_alone(user, means):
    commit(user.parent, "law.py", "REGULATOR = None\n")
    user.write_text(LAW)
    said = gates.compare_revisions("HEAD", None, (user,), functions=means())
    assert "base has no such law, or it does not load" in said.gates[0].says


@pytest.mark.parametrize(
    ("base", "head", "verdicts", "state"),
    [
        ((), ("chatter",), ["regression"], "failed"),
        (("chatter",), ("chatter",), [], "passed"),
        (("chatter",), (), ["improvement"], "passed"),
    ],
)
def test_fault_that_base_has_not_is_a_regression(user, means, base, head, verdicts, state):
    user.write_text(LAW + "# another\n")
    said = gates.compare_revisions(
        "HEAD", None, (user,), functions=means(faults=head, base_faults=base)
    )
    assert [one.verdict for one in said.findings] == verdicts
    assert states(said)["faults"] == state
    assert ("- It shakes. (appendix-method)" in summary.write_markdown(said)) == bool(head)


def test_law_that_cannot_be_judged_is_a_regression(user, means):
    said = gates.compare_revisions(
        "HEAD", None, (user,), functions=means(faults=BadLaw("it cannot be compiled"))
    )
    assert [(one.gate, one.says) for one in said.regressions] == [("faults", "it cannot be compiled")]


def test_runs_of_two_schemas_are_a_regression_and_no_mistake(user, means, finished):
    (finished / "episodes.parquet").unlink()
    [found] = gates.compare_revisions("HEAD", None, (user,), functions=means()).regressions
    assert found.says.startswith("the schema differs: ")
    assert "episodes.parquet" in found.says


def test_command_adds_to_the_summaries(finished, tmp_path, monkeypatch, capsys):
    job, own = tmp_path / "job.md", tmp_path / "own.md"
    job.write_text("before\n")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(job))
    assert main(["compare", str(finished), str(finished), "--summary", str(own)]) == 0
    assert "agrees with" in capsys.readouterr().out
    assert job.read_text() == "before\n" + own.read_text()
    assert own.read_text().startswith("### no regression: ")


def test_summary_says_why_nothing_was_judged(tmp_path, capsys):
    words = ["compare", str(tmp_path), str(tmp_path), "--summary", str(tmp_path / "own.md")]
    assert main(words) == 2
    said = capsys.readouterr().err.removeprefix("error: ")
    assert (tmp_path / "own.md").read_text().replace("\\`", "`") == f"### Not judged: {said}"


def test_markdown_leaves_no_markup_of_what_it_quotes(finished):
    said = gates.compare_folders(finished, finished)
    said.findings = [Finding("exact", "regression", "a", "a|b <img src=x> `c` *d*")]
    text = summary.write_markdown(said)
    assert "- **regression**: a\\|b &lt;img src=x&gt; \\`c\\` \\*d\\*" in text
    assert text.startswith("### 1 regression: ")


def test_base_is_where_a_branch_left_main_and_on_main_what_was_before(user):
    folder = user.parent
    first, second = git(folder, "rev-parse", "HEAD~1"), git(folder, "rev-parse", "HEAD")
    assert find_default_base(folder, None) == find_default_base(folder, "main") == first
    user.write_text("changed")
    assert find_default_base(folder, None) == second
    git(folder, "checkout", "-qf", "-b", "work", first)
    commit(folder, "mine", "")
    assert find_default_base(folder, None) == first
    git(folder, "branch", "-m", "main", "trunk")
    with pytest.raises(Incompatible, match="name the base"):
        find_default_base(folder, None)


def test_words_that_name_nothing_are_refused(user, tmp_path):
    with pytest.raises(UnknownWord, match=r"revision 'mian' is unknown \(did you mean 'main'\?\)"):
        find_commit(user.parent, "mian")
    assert is_folder(str(tmp_path))
    assert not is_folder("main~2")
    with pytest.raises(BadResults, match="no such folder"):
        is_folder(str(tmp_path / "nowhere"))


@pytest.mark.parametrize("error", [None, KeyboardInterrupt, ValueError])
def test_checkout_holds_the_commit_as_old_as_it_is_and_is_gone_afterwards(user, error):
    folder, first = user.parent, git(user.parent, "rev-parse", "HEAD")
    user.write_text("changed")
    with pytest.raises(error) if error else contextlib.nullcontext(), check_out(folder, first) as path:
        assert (path / "law.py").read_text() == LAW
        assert (path / "law.py").stat().st_mtime == int(git(folder, "show", "--no-patch", "--format=%ct", first))
        (path / "new").write_text("")
        if error:
            raise error
    assert not path.exists()
    assert git(folder, "worktree", "list").count("\n") == 0


def test_repository_is_that_of_the_users_law(user, tmp_path):
    assert find_repository((user,)) == user.parent
    with pytest.raises(Incompatible, match="not a git repository"):
        find_repository((tmp_path / "law.py",))
