"""A user's file is read by a process of its own: the law is known by its words, whatever the file does there."""

import os
from pathlib import Path

import psutil
import pytest
from support.user_law import law_text

from bench.contenders.described_law import described, fields_of
from bench.contenders.law_file import load_law
from bench.contenders.law_process import TOKEN
from bench.errors import BadLaw

SOUND = law_text("return (-kp * R.n[0], 0.0, 0.0)").replace("kp *", "gains.kp *")


def written(folder: Path, text: str) -> Path:
    path = folder / "own.py"
    path.write_text(text)
    return path


def carriers() -> list[psutil.Process]:
    """Processes of laws that this one, or one of its processes, started and that run still."""
    found = []
    for process in psutil.process_iter():
        try:
            if TOKEN in process.environ() and process.status() != psutil.STATUS_ZOMBIE:
                found.append(process)
        except psutil.Error:
            continue
    return found


@pytest.mark.parametrize(
    "more",
    [
        "",
        ", short='own', family='Mine', look=Look('sky', 'h', 'dotted'), property='local', stiffness=(1.0, 0.5, 1.0)",
        ", memory=(1.0, 0.0)",
    ],
)
def test_words_of_a_law_are_those_of_its_file(tmp_path, more):
    text = SOUND.replace("law)", f"law{more})").replace("import Regulator", "import Look, Regulator")
    if "memory" in more:
        text = text.replace("goal, gains)", "goal, gains, memory)").replace("0.0, 0.0)\n", "0.0, 0.0), memory\n")
    path = written(tmp_path, text)
    own = described(path)
    assert fields_of(own) == fields_of(load_law(path))
    assert own.origin == str(path)
    with pytest.raises(RuntimeError, match="in its sandbox alone"):
        own.law()


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("import os; os._exit(0)", "it ended its process, exit code 0"),
        ("import ctypes; ctypes.string_at(0)", "it ended its process, SIGSEGV"),
        ("while True: pass", "it did not return within 1 s"),
        ("import time; time.sleep(1000)", "it did not return within 1 s"),
        ("a = bytearray(64 << 30)", "MemoryError in line 1"),
        ("import sys; sys.exit(3)", "SystemExit in line 1: 3"),
    ],
)
def test_file_that_does_not_load_is_refused_with_what_it_did(tmp_path, line, reason, monkeypatch):
    path = written(tmp_path, f"{line}\n{SOUND}")
    with pytest.raises(BadLaw) as refused:
        described(path, limit_s=1.0, waits_s=2.0)
    assert str(path) in str(refused.value)
    assert reason in str(refused.value)


@pytest.mark.parametrize(
    "lines",
    [
        "for i in range(100000): print('x' * 100)",
        "if not os.fork(): time.sleep(1000)",
        "if not os.fork():\n    os.setsid()\n    time.sleep(1000)",
    ],
)
def test_file_that_prints_or_forks_is_read_and_leaves_no_process(tmp_path, lines):
    before = {process.pid for process in carriers()}
    assert described(written(tmp_path, f"import os, time\n{lines}\n{SOUND}")).name == "mine"
    assert not [process for process in carriers() if process.pid not in before and process.ppid() in (1, os.getpid())]


@pytest.mark.parametrize("body", ["raise ValueError('no')", "while R.n[0] < 2.0: x = 1.0", "os._exit(0)"])
def test_law_that_does_not_answer_is_known_all_the_same(tmp_path, body):
    text = law_text(body, "return omega")
    assert described(written(tmp_path, f"import os\n{text}"), limit_s=2.0, waits_s=5.0).name == "mine"
