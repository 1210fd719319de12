"""Hold each room to its syntax nodes, and to how many of them stand on a line (`tests/support/density.py`)."""

import pytest
from support.density import (
    RATIO_SLACK,
    ROOT,
    SLACK,
    Density,
    list_rooms,
    measure_files,
    measure_source,
    name_room,
    read_limits,
    set_limits,
    write_limits,
)

ROOMS = list_rooms()
LIMITS = read_limits()
LONGEST_FILE = 400
FEWEST_NODES = 100
"""The least slack of a room: 3 % of a room of two files is less than a line."""
COMMAND = "python -m tests.support.density"

DOCUMENTED = '''"""Say what the module is.

It has two paragraphs.
"""

SPEED = 2  # rad/s
"""How fast."""


def double(x):
    """Return it twice."""
    return (
        x
        + x
    )
'''


@pytest.fixture(scope="module", params=ROOMS)
def room(request):
    """A room: its name, its counts, and its limits."""
    name = request.param
    assert name in LIMITS, f"{name} has no limits yet: add those that `{COMMAND}` prints"
    return name, measure_files(ROOMS[name]), LIMITS[name]


def test_a_room_has_at_most_three_percent_more_nodes_than_at_the_last_release(room):
    name, density, limits = room
    most = max(SLACK * limits["nodes"], limits["nodes"] + FEWEST_NODES)
    assert density.nodes <= most, (
        f"{name} has {density.nodes} syntax nodes, at most {most:.0f} until the next release: remove a mechanism, not "
        "characters"
    )


def test_a_room_has_no_more_nodes_on_a_line_than_before(room):
    name, density, limits = room
    most = RATIO_SLACK * limits["nodes_per_line"]
    assert density.nodes_per_line <= most, (
        f"{name} has {density.nodes_per_line:.2f} syntax nodes per code line, at most {most:.2f}: unfold, a step a line"
    )


def test_a_room_has_no_greater_share_of_wide_lines_than_before(room):
    name, density, limits = room
    most = RATIO_SLACK * limits["wide_percent"]
    assert density.wide_percent <= most, (
        f"{density.wide_percent:.2f} % of the lines of {name} have over 100 columns, at most {most:.2f} %: break them"
    )


def test_no_room_that_is_gone_keeps_its_limits():
    assert set(LIMITS) <= set(ROOMS)


def test_no_file_is_longer_than_400_lines():
    lengths = {
        str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines())
        for paths in ROOMS.values()
        for path in paths
    }
    long = {name: lines for name, lines in lengths.items() if lines > LONGEST_FILE}
    assert not long, "split by subject what became too long"


def test_every_room_of_the_layers_is_measured():
    for name in ("bench/audit", "bench/law", "bench/findings", "report", "tasks", "tests"):
        assert ROOMS[name]
    assert name_room(ROOT / "bench" / "__main__.py") == "bench"
    assert name_room(ROOT / "bench" / "law" / "contenders" / "registry.py") == "bench/law"
    assert name_room(ROOT / "tests" / "conftest.py") == "tests"


def test_docstrings_contexts_and_comments_are_no_nodes():
    # Module; Assign, Name, Constant; FunctionDef, arguments, arg, Return, BinOp, Name, Add, Name
    density = measure_source(DOCUMENTED)
    assert density.nodes == 12
    assert density.code_lines == 6
    assert density.lines == 15


def test_a_string_that_is_used_is_a_node():
    # Module, Assign, Name, Constant
    assert measure_source('TEXT = """one\ntwo"""\n') == Density(nodes=4, code_lines=2, lines=2)


def test_a_line_of_101_columns_is_wide():
    narrow, wide = "x" * 100, "x" * 101
    assert measure_source(f"{narrow}\n{wide}\n").wide_percent == 50.0


def test_folding_the_same_code_raises_nodes_per_line_alone():
    unfolded = measure_source("values = [\n    1,\n    2,\n]\n")
    folded = measure_source("values = [1, 2]\n")
    assert folded.nodes == unfolded.nodes
    assert folded.nodes_per_line > unfolded.nodes_per_line


def test_new_limits_follow_the_nodes_but_ratios_only_fall():
    denser = Density(nodes=1200, code_lines=100, lines=200, wide_lines=20)
    previous = {"nodes": 1000, "nodes_per_line": 8.0, "wide_percent": 12.0}
    assert set_limits(denser, previous) == {"nodes": 1200, "nodes_per_line": 8.0, "wide_percent": 10.0}
    assert set_limits(denser, {}) == {"nodes": 1200, "nodes_per_line": 12.0, "wide_percent": 10.0}


def test_the_command_prints_limits_of_every_room():
    text = write_limits()
    for room in ROOMS:
        assert f'["{room}"]\n' in text
