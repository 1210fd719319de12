"""Files that a command writes: a regular file is replaced, and nothing else is."""

import os
import stat
from pathlib import Path

import pytest
from support.command_line import refused

from bench import cli
from bench.base.errors import BadResults
from bench.base.files import write_atomically


def make_device(path):
    """A device of this test's own, which gives and takes nothing: numbers 1, 3 as /dev/null."""
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(1, 3))
    except PermissionError:
        pytest.skip("only root makes devices")


def make_link(path):
    path.with_name("target").write_text("as it was")
    path.symlink_to(path.with_name("target"))


def make_lost_link(path):
    path.symlink_to(path.with_name("nowhere"))


MADE = {
    "a device": make_device,
    "a pipe": os.mkfifo,
    "a folder": os.mkdir,
    "a link": make_link,
    "a link to nothing": make_lost_link,
}


@pytest.mark.parametrize("kind", MADE)
def test_what_is_no_regular_file_is_left_as_it_is(tmp_path, kind):
    path = tmp_path / "out.json"
    MADE[kind](path)
    before = path.lstat()
    with pytest.raises(BadResults, match=f"it is {kind.removesuffix(' to nothing')}, and only a regular file"):
        write_atomically(path, lambda temporary: None)
    after = path.lstat()
    assert (after.st_mode, after.st_ino, after.st_rdev) == (before.st_mode, before.st_ino, before.st_rdev)
    if kind == "a link":
        assert path.read_text() == "as it was"
    assert not list(tmp_path.glob(".*"))


def test_regular_file_is_replaced(tmp_path):
    path = tmp_path / "out.json"
    path.write_text("before")
    write_atomically(path, lambda temporary: Path(temporary).write_text("after"))
    assert path.read_text() == "after"


@pytest.mark.parametrize("kind", MADE)
@pytest.mark.parametrize("words", [("prove", "--out"), ("compare", "--summary")])
def test_command_refuses_it_before_it_works(capsys, tmp_path, words, kind):
    path = tmp_path / "out"
    MADE[kind](path)
    line = refused(capsys, *words, path)
    assert line.startswith(f"error: {words[1]} {path}: it is {kind.removesuffix(' to nothing')}")


@pytest.mark.parametrize(
    ("command", "says"),
    [
        ("run", "what was finished is kept"),
        ("map", "what was finished is kept"),
        ("judge", "nothing was written"),
        ("advise", "nothing was written"),
        ("prove", "keeps nothing"),
    ],
)
def test_command_that_is_stopped_says_what_becomes_of_its_work(capsys, monkeypatch, command, says):
    def stop(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(cli.bench, "main", stop)
    assert cli.main([command, "law"]) == 130
    assert says in capsys.readouterr().err
