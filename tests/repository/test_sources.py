"""What a file's digest is of, and which modules a file is said to import."""

import pytest

from bench.base.sources import Reader, scan

CODE = '''"""Say what it is."""

from a.b import c, d

LIMIT = 3
"""How many."""


def count(x):
    """Count."""
    import e.f

    assert x
    if x > LIMIT:
        return f"{x}"
    return "text"
'''

SAME = [
    ('"""Say what it is."""', '"""Say, what it is."""'),
    ('"""How many."""', ""),
    ('    """Count."""\n', "    # a comment\n\n"),
    ("x > LIMIT", "(x  >  LIMIT)"),
    ("LIMIT = 3", "LIMIT = 0x3"),
]

OTHER = [
    ("LIMIT = 3", "LIMIT = 4"),
    ("LIMIT = 3", "LIMIT = 3.0"),
    ("x > LIMIT", "x >= LIMIT"),
    ("    assert x\n", ""),
    ('return "text"', 'return "words"'),
    ('f"{x}"', 'f"{x!r}"'),
    ("def count", "def sum_up"),
    ("from a.b import c, d", "from a.b import d, c"),
]


@pytest.mark.parametrize(("old", "new"), SAME)
def test_comments_docstrings_and_spaces_are_no_code(old, new):
    assert old in CODE
    assert scan(CODE.replace(old, new).encode()).code == scan(CODE.encode()).code


@pytest.mark.parametrize(("old", "new"), OTHER)
def test_everything_else_is(old, new):
    assert old in CODE
    assert scan(CODE.replace(old, new).encode()).code != scan(CODE.encode()).code


def test_imports_are_found_in_functions_too():
    assert scan(CODE.encode()).imports == ("a.b.c", "a.b.d", "e.f")


def test_relative_imports_start_from_the_package():
    text = b"from . import a\nfrom .b import c\nfrom ..d import e\nfrom .. import f\n"
    assert scan(text, "tasks.arms").imports == ("tasks.arms.a", "tasks.arms.b.c", "tasks.d.e", "tasks.f")


@pytest.fixture
def checkout(tmp_path):
    """Files of packages: text by name."""
    texts = {
        "tasks/__init__.py": "",
        "tasks/rules.py": "import math\nLIMIT = 3\n",
        "tasks/starts/__init__.py": "",
        "tasks/starts/poles.py": "from bench.law import Law\n",
        "bench/__init__.py": "",
        "bench/law/__init__.py": "from bench.law.kinds import Law\n",
        "bench/law/kinds.py": "from tasks.rules import LIMIT\n",
        "bench/law/other.py": "from tasks import starts\n",
    }
    for name, text in texts.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path


def follow(checkout, module):
    return {path.relative_to(checkout).as_posix() for path in Reader(checkout).follow(module)}


def test_file_depends_on_what_it_imports_and_on_its_packages(checkout):
    needed = {"bench/__init__.py", "bench/law/__init__.py", "bench/law/kinds.py", "tasks/__init__.py", "tasks/rules.py"}
    assert follow(checkout, "bench.law.kinds") == needed


def test_package_that_is_imported_by_name_brings_all_its_modules(checkout):
    found = follow(checkout, "bench.law.other")
    assert {"bench/law/other.py", "tasks/starts/__init__.py", "tasks/starts/poles.py"} <= found


def test_digests_are_kept_by_content(checkout, tmp_path):
    memory = tmp_path / "kept.json"
    paths = sorted(checkout.rglob("*.py"))
    first = Reader(checkout, memory).digest(paths)
    kept = memory.read_text()
    assert Reader(checkout, memory).digest(paths) == first
    (checkout / "tasks/rules.py").write_text("LIMIT = 4\n")
    assert Reader(checkout, memory).digest(paths) != first
    memory.write_text("{ damaged")
    (checkout / "tasks/rules.py").write_text("import math\nLIMIT = 3  # a comment\n")
    assert Reader(checkout, memory).digest(paths) == first
    assert memory.read_text() != kept


def test_file_that_changed_since_it_was_read_is_noticed(checkout):
    reader = Reader(checkout)
    path = checkout / "tasks/rules.py"
    before = reader.read(path)
    assert reader.is_unchanged()
    path.write_text("LIMIT = 5\n")
    assert not reader.is_unchanged()
    assert reader.read(path) == before
