"""No test and no study assigns to a module's globals: what they vary is a parameter, or is seen from the outside."""

import ast

import pytest

from bench.base.provenance import ROOT

FILES = [path for folder in ("tests", "bench/studies") for path in sorted((ROOT / folder).rglob("*.py"))]

PLANTED = {
    "tests/cli/test_written_files.py": "a command that is interrupted at once",
    "tests/law/test_attribution.py": "a law whose file has no attribution",
    "tests/studies/test_situations.py": "few laws and small runs, so that a study takes seconds",
    "tests/regression/test_regress_times.py": "a commit of the history, which only git knows",
    "tests/cli/test_summary.py": "verdicts, an answer and a run that are missing, to see what the summary says",
    "tests/findings/test_claims.py": "a run that decides one claim of two",
    "tests/report/test_colours.py": "a law of the user, which no run here has",
    "tests/report/test_pictures_of_laws.py": "an answer without a map",
    "tests/report/test_comparing_sentences.py": "what a page reads, made false for one sentence",
}
"""Files whose tests replace a reader for one test, by a fixture that restores it."""


def assignments(text: str) -> list[int]:
    """The lines on which an attribute of an imported module is set: by `=`, setattr, or a path of dots in a string."""
    tree, modules, found = ast.parse(text), set(), []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            modules |= {(one.asname or one.name).partition(".")[0] for one in node.names}

    def of_module(node) -> bool:
        while isinstance(node, ast.Attribute):
            node = node.value
        is_path = isinstance(node, ast.Constant) and isinstance(node.value, str) and "." in node.value
        return is_path or (isinstance(node, ast.Name) and node.id in modules)

    for node in ast.walk(tree):
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
        if any(isinstance(one, ast.Attribute) and of_module(one) for one in targets):
            found.append(node.lineno)
        called = getattr(node.func, "attr", getattr(node.func, "id", "")) if isinstance(node, ast.Call) else ""
        if called in ("setattr", "patch") and of_module(node.args[0]):
            found.append(node.lineno)
    return found


def test_globals_of_modules_are_left_alone():
    """What a test varies is given as a parameter, or looked at from the outside."""
    lines = {path.relative_to(ROOT).as_posix(): assignments(path.read_text(encoding="utf-8")) for path in FILES}
    assert {name for name, found in lines.items() if found} == set(PLANTED)


@pytest.mark.parametrize(
    "line", ["store.GROUP = 4", "monkeypatch.setattr(store, 'GROUP', 4)", "setattr(store.pq, 'x', 4)",
             "monkeypatch.setattr('bench.experiments.tables.store.GROUP', 4)", "store.GROUP += 4"],
)  # fmt: skip
def test_assignment_is_found(line):
    assert assignments(f"from bench.experiments.tables import store\n{line}") == [2]
    assert assignments(f"store = object()\n{line}") == ([2] if "'bench." in line else [])
