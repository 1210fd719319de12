"""Find docstrings without a verb at their start, and phrases that a reader from elsewhere stops at."""

import ast
import io
import re
import tokenize
from pathlib import Path

import pytest

from bench.base.provenance import ROOT

FRAGMENT = re.compile(r"(Of|Those|The same|That|As|By|Where|Whose)\b")
PHRASES = re.compile(
    r"\b(what is asked|told|by itself|anew|shall|stands? beside|is blamed|lets go|on the way home|at the most"
    r"|and not others|of laws those that|nought|half turns?|dead points?|(long|short|way) (way )?round)\b",
    re.IGNORECASE,
)
PROSE = ("README.md", "CONTRIBUTING.md", "SECURITY.md", "Makefile")
BOOK = [ROOT / "report" / "index.md", *sorted((ROOT / "report" / "pages").glob("*.md"))]


def list_sources() -> list[Path]:
    """Return the Python files of the rooms that the rules hold for."""
    found = [path for room in ("bench", "tasks", "report") for path in sorted((ROOT / room).rglob("*.py"))]
    return [path for path in found if not path.is_relative_to(ROOT / "report/_build")]


def list_texts(path: Path) -> list[tuple[int, str]]:
    """Return the line and text of every docstring and comment of a module; of the command line, of every string."""
    source = path.read_text(encoding="utf-8")
    is_command = path.is_relative_to(ROOT / "bench/cli")
    texts = []
    for node in ast.walk(ast.parse(source)):
        constant = node if is_command else node.value if isinstance(node, ast.Expr) else None
        if isinstance(constant, ast.Constant) and isinstance(constant.value, str):
            texts.append((constant.lineno, constant.value))
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    return texts + [(one.start[0], one.string) for one in tokens if one.type == tokenize.COMMENT]


def find_fragments(path: Path) -> list[str]:
    """Return the docstrings of a module, of constants too, that begin with a word that leaves out the verb."""
    nodes = [node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, ast.Expr)]
    texts = [(one.lineno, one.value.value) for one in nodes if isinstance(one.value, ast.Constant)]
    found = [(line, text.strip()) for line, text in texts if isinstance(text, str)]
    return [f"{path}:{line}: {text.splitlines()[0]}" for line, text in found if FRAGMENT.match(text)]


def find_phrases(path: Path) -> list[str]:
    """Return the forbidden phrases in the docstrings and comments of a module, or in a file of prose."""
    text = path.read_text(encoding="utf-8")
    texts = list_texts(path) if path.suffix == ".py" else list(enumerate(text.splitlines(), 1))
    return [f"{path}:{line}: {one[0]}" for line, words in texts for one in PHRASES.finditer(" ".join(words.split()))]


def test_docstrings_begin_with_a_verb():
    tests = (ROOT / "tests").rglob("*.py")
    assert not [line for path in (*list_sources(), *tests) for line in find_fragments(path)]


def test_prose_has_no_phrase_that_needs_its_author():
    assert not [line for path in (*list_sources(), *BOOK, *map(ROOT.joinpath, PROSE)) for line in find_phrases(path)]


def test_planted_fragment_and_phrases_are_found(tmp_path):
    planted = tmp_path / "planted.py"
    planted.write_text(
        '"""Return it."""\n\n\ndef f(half_turn):\n    """Of a half\n    turn."""\n    return 1  # anew\n'
    )
    assert find_fragments(planted) == [f"{planted}:5: Of a half"]
    assert find_phrases(planted) == [f"{planted}:5: half turn", f"{planted}:7: anew"]


@pytest.mark.parametrize("name", PROSE)
def test_prose_fits_its_width_and_names_paths_that_exist(name):
    text = (ROOT / name).read_text(encoding="utf-8")
    # A row of a table is one line, whatever its length.
    wide = [line for line in text.splitlines() if len(line) > 120 and not line.startswith("|")]
    assert name not in PROSE[:2] or not wide
    named = re.findall(r"(?:`|\]\()((?:bench|tasks|report|results|tests)/[\w./-]*)[`)]", text)
    made_later = ("report/_build", "results/mine", "results/latest")
    assert not [path for path in named if not path.startswith(made_later) and not (ROOT / path).exists()]
