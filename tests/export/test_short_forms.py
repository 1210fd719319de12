"""Short forms of laws: at most 12 lines, equal to the law in NumPy, JAX and PyTorch, with gradients in the last two."""

import json
import subprocess
from pathlib import Path

import pytest
from support import short_forms

from bench.export.language import write_vectors
from bench.export.short import FORMS, short_files, write_short
from bench.export.subject import find_subject

PYTHON = Path(__file__).parents[2] / ".venv-arrays" / "bin" / "python"


def write(word, folder):
    here, subject = folder / word.replace("/", "-"), find_subject(word)
    here.mkdir()
    for name, text in {**short_files(subject), "vectors.json": write_vectors(subject)}.items():
        (here / name).write_text(text, encoding="utf-8")
    return here


@pytest.mark.parametrize("word", FORMS["laws"])
def test_short_form_of_at_most_12_lines_is_equal_to_the_law(tmp_path, word):
    assert sum(bool(line) for line in write_short(word).splitlines()) <= 12
    assert short_forms.hold("numpy", write(word, tmp_path)) < 1.0


@pytest.mark.weekly
@pytest.mark.skipif(not PYTHON.exists(), reason="JAX and PyTorch are not installed (6 GB: make arrays)")
@pytest.mark.parametrize("library", ["jax", "torch"])
def test_arrays_of_other_libraries_give_the_law_and_finite_gradients(tmp_path, library):
    words = [PYTHON, short_forms.__file__, library, *(write(word, tmp_path) for word in FORMS["laws"])]
    ended = subprocess.run(words, env={"JAX_ENABLE_X64": "1"}, capture_output=True, text=True, check=True)
    assert {law: ratio for law, ratio in json.loads(ended.stdout).items() if not ratio < 1.0} == {}
