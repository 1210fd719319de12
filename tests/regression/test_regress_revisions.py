"""What BASE and HEAD mean, and checkouts that leave nothing behind."""

import subprocess

import pytest

from bench.errors import BadResults, Incompatible, UnknownWord
from bench.regression.revisions.commits import commit_of, default_base, git, is_folder, repository, worktree

AS_NOBODY = ("-c", "user.name=nobody", "-c", "user.email=nobody@example.org", "-c", "commit.gpgsign=false")


def commit(folder, text):
    (folder / "law.py").write_text(text)
    subprocess.run(["git", "-C", folder, "add", "law.py"], check=True)
    subprocess.run(["git", *AS_NOBODY, "-C", folder, "commit", "-qm", text], check=True)
    return git(folder, "rev-parse", "HEAD")


@pytest.fixture
def user(tmp_path):
    """A user's repository with two commits on main: its folder and their names."""
    folder = tmp_path / "user"
    folder.mkdir()
    subprocess.run(["git", "init", "-q", "-b", "main", folder], check=True)
    return folder, commit(folder, "one"), commit(folder, "two")


def test_base_is_the_commit_before_on_main(user):
    folder, first, second = user
    assert default_base(folder, None) == first
    assert default_base(folder, "main") == first
    assert second != first


def test_base_is_the_last_commit_on_main_when_files_have_changed_since(user):
    folder, _, second = user
    (folder / "law.py").write_text("three")
    assert default_base(folder, None) == second


def test_base_is_where_a_branch_left_main(user):
    folder, first, _ = user
    git(folder, "checkout", "-q", "-b", "work", first)
    commit(folder, "mine")
    assert default_base(folder, None) == first


def test_base_must_be_named_where_there_is_no_main(user):
    folder, *_ = user
    git(folder, "branch", "-m", "trunk")
    with pytest.raises(Incompatible, match="name the base"):
        default_base(folder, None)


def test_unknown_revision_is_refused_with_those_there_are(user):
    with pytest.raises(UnknownWord, match=r"revision 'mian' is unknown \(did you mean 'main'\?\)"):
        commit_of(user[0], "mian")


def test_worktree_holds_the_commit_and_is_gone_afterwards(user):
    folder, first, _ = user
    with worktree(folder, first) as path:
        assert (path / "law.py").read_text() == "one"
        assert (folder / "law.py").read_text() == "two"
    assert not path.exists()
    assert git(folder, "worktree", "list").count("\n") == 0
    assert git(folder, "status", "--porcelain") == ""


def spoil(folder, first, error):
    """Change what is checked out, and fail."""
    with worktree(folder, first) as path:
        (path / "law.py").write_text("changed")
        (path / "new").write_text(str(path))
        raise error(path)


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError])
def test_worktree_is_gone_after_a_failure(user, error):
    folder, first, _ = user
    with pytest.raises(error) as caught:
        spoil(folder, first, error)
    [path] = caught.value.args
    assert not path.exists()
    assert git(folder, "worktree", "list").count("\n") == 0


def test_worktree_has_files_as_old_as_the_commit_so_that_compiled_code_is_found_again(user):
    folder, first, _ = user
    with worktree(folder, first) as path, worktree(folder, first) as other:
        assert (path / "law.py").stat().st_mtime == int(git(folder, "show", "--no-patch", "--format=%ct", first))
        assert other != path
    with worktree(folder, first) as again:
        assert again == path


def test_word_is_a_folder_if_it_is_there_and_a_mistake_if_it_is_written_like_one(tmp_path):
    assert is_folder(str(tmp_path))
    assert not is_folder("main~2")
    with pytest.raises(BadResults, match="no such folder"):
        is_folder(str(tmp_path / "nowhere"))


def test_repository_is_that_of_the_users_law(user, tmp_path):
    folder, *_ = user
    assert repository((folder / "law.py",)) == folder
    other = tmp_path / "other"
    other.mkdir()
    subprocess.run(["git", "init", "-q", other], check=True)
    with pytest.raises(Incompatible, match="several repositories"):
        repository((folder / "law.py", other / "law.py"))
    with pytest.raises(Incompatible, match="not a git repository"):
        repository((tmp_path / "law.py",))
