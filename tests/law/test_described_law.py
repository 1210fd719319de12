"""A user's file is read by a process of its own: the law is known by its words, whatever the file does there."""

from pathlib import Path

import pytest
from support.user_law import law_text

from bench.law.contenders.described_law import described, fields_of
from bench.law.contenders.law_file import load_law

SOUND = law_text("return (-kp * R.n[0], 0.0, 0.0)").replace("kp *", "gains.kp *")


def written(folder: Path, text: str) -> Path:
    path = folder / "own.py"
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    "more",
    [
        "",
        ", display=Display('own', Look('sky', 'h', 'dotted'), 'Mine'), property='local', stiffness=(1.0, 0.5, 1.0)",
        ", memory=(1.0, 0.0)",
    ],
)
def test_words_of_a_law_are_those_of_its_file(tmp_path, more):
    text = SOUND.replace("law)", f"law{more})").replace("import Law", "import Display, Law, Look")
    if "memory" in more:
        text = text.replace("goal, gains)", "goal, gains, memory)").replace("0.0, 0.0)\n", "0.0, 0.0), memory\n")
    path = written(tmp_path, text)
    own = described(path)
    assert fields_of(own) == fields_of(load_law(path))
    assert own.origin == str(path)
    with pytest.raises(RuntimeError, match="in its sandbox alone"):
        own.law()


@pytest.mark.parametrize("body", ["raise ValueError('no')", "while R.n[0] < 2.0: x = 1.0", "os._exit(0)"])
def test_law_that_does_not_answer_is_known_all_the_same(tmp_path, body):
    text = law_text(body, "return omega")
    assert described(written(tmp_path, f"import os\n{text}"), limit_s=2.0, waits_s=5.0).name == "mine"
