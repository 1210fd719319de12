"""Laws as JavaScript: our vectors in node, our bits, and a page that loads a law from a file."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from support.exported import ANSWERS, KP, KV, laws, needs, our_answers, states, subjects, written

from bench.export.subject import find_subject, translated

NODE = str(Path(shutil.which("node") or "/usr/bin/node").parent)
SOME = 20_000


@needs("node")
def test_vectors_pass_in_node_where_nothing_of_ours_is_installed(tmp_path):
    for one in subjects():
        here = written(one, "js", tmp_path)
        words = ["node", f"test_{one.identifier}.js"]
        ended = subprocess.run(words, cwd=here, env={"PATH": NODE}, capture_output=True, text=True)
        assert (ended.returncode, " 0 of " in ended.stdout) == (0, True), (one.word, ended.stdout, ended.stderr)


@needs("node")
def test_algebraic_laws_give_our_bits_in_node(tmp_path):
    found = [(one, find_subject(one.name)) for one in laws()]
    algebraic = [(one, subject) for one, subject in found if translated(subject).program.is_algebraic]
    assert len(algebraic) >= 12
    names = [subject.identifier for _, subject in algebraic]
    for _, subject in algebraic:
        written(subject, "js", tmp_path)
    (tmp_path / "states").write_bytes(states()[:: len(states()) // SOME].tobytes())
    (tmp_path / "laws.json").write_text(json.dumps(names))
    numbers = {"WIDTH_OUT": ANSWERS, "COUNT": SOME, "KP": KP, "KV": KV}
    text = Path(__file__).with_name("ask.js").read_text()
    for word, number in numbers.items():
        text = text.replace(word, str(number))
    (tmp_path / "ask.js").write_text(text)
    subprocess.run(["node", "ask.js"], cwd=tmp_path, check=True)
    for contender, subject in algebraic:
        columns = slice(ANSWERS if subject.memory else 3)
        theirs = np.fromfile(tmp_path / f"{subject.identifier}.answers").reshape(SOME, ANSWERS)[:, columns]
        ours = our_answers(contender)[:: len(states()) // SOME, columns]
        same = (ours == theirs) | (np.isnan(ours) & np.isnan(theirs))
        assert same.all(), (contender.name, np.argwhere(~same)[:3])


@needs("node")
@pytest.mark.parametrize("way", ["require", "import", "script"])
def test_script_loads_in_every_way(tmp_path, way):
    here = written(find_subject("late-braking"), "js", tmp_path)
    said = "console.log(Object.keys(law).length, law.reset().memory.length)"
    text = {
        "require": f"const law = require('./late_braking.js'); {said}",
        "import": f"import law from './late_braking.js'; {said}",
        # what a script element does: the text is run as it is, where there is no module
        "script": "const vm = require('vm'), fs = require('fs'), page = vm.createContext({});"
        f"vm.runInContext(fs.readFileSync('late_braking.js', 'utf8'), page); const law = page.late_braking; {said}",
    }[way]
    name = "try.mjs" if way == "import" else "try.js"
    (here / name).write_text(text)
    ended = subprocess.run(["node", name], cwd=here, capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["7", "4"]
