"""On what compiled code depends: in a copy of the sources with one change, which functions get another stamp?"""

import json
import os
import shutil
from pathlib import Path

import pytest
from support.command_line import python

from bench.base.provenance import ROOT, versions
from bench.engines.dependencies import describe_setting
from bench.engines.kept_code import prune

STAMPS = """
import json
import numba
from bench.base.provenance import source_digest
from bench.engines import compiled, signatures, simulate
from bench.engines.dependencies import stamp_of
from bench.engines.metrics.registry import metrics_of
from bench.experiments.limiters import clamp_axes
from bench.law.contenders.registry import contenders, find_contender
from bench.law.contender import Contender

numba.njit = lambda *signature, **options: lambda function: stamp_of(function).digest
laws = {name: find_contender(name) for name in ("mrp", "mrp-memory", "linearized-euler/zyx-euler")}
laws["deoxys"] = Contender(contenders("shipped")["deoxys"].law)
stamps = {name: simulate.evaluation(law) for name, law in laws.items()}
for kind in ("ideal-rk4", "perturbed", "arm"):
    stamps[kind] = simulate.compiled_loop(kind, tuple(metrics_of(kind == "arm")))
stamps["limiter"] = compiled.part(clamp_axes, signatures.LIMIT)
print(json.dumps(stamps | {"rows": source_digest()}))
"""

NUMBA = {"ORIENTATION_BENCH_COMPILER": "numba"}
"""Variables of processes in which numba compiles though there is a C compiler."""

LOOPS = {"ideal-rk4", "perturbed", "arm"}
LAWS = {"mrp", "mrp-memory", "linearized-euler/zyx-euler", "deoxys"}
WIDE = {"rows"}
"""Rows: their modules import the experiments, and these all there is."""
CODE = LOOPS | LAWS | {"limiter"}

HARMLESS = [
    "bench/audit/examined.py",
    "bench/experiments/free_body.py",
    "bench/engines/binding.py",
    "bench/engines/loop.py",
    "bench/law/contenders/regulators/mrp.py",
    "tasks/verdict.py",
]
"""Files that get a comment, more lines, and another docstring."""

LOCAL = [
    # a constant of a limiter, which its kernel uses in a function of another module
    ("bench/experiments/limiters.py", "GREATEST_RATE = 2.0", "GREATEST_RATE = 1.5"),
    # the formula of a law that no other law uses
    ("bench/law/contenders/regulators/mrp_memory.py", "memory, DELTA)", "memory, 0.5 * DELTA)"),
    # a number in a data file, which a function holds in a closure
    ("bench/law/contenders/shipped/deoxys.toml", "deadband = 0.005", "deadband = 0.006"),
]
"""File, text, and what is put in its place; each changes the code of one function."""

WIDER = [
    # a constant that laws use through an import
    ("bench/law/side.py", "DELTA = 0.4", "DELTA = 0.3", CODE),
    # the formula of a law that another one uses
    ("bench/law/contenders/regulators/mrp.py", "4.0 * gains", "3.0 * gains", {"mrp", "mrp-memory"}),
    # a function of the judge; a hook and a metric, which are found by looking into their folders
    ("tasks/verdict.py", "inside = haversine <= band", "inside = haversine < band", CODE),
    ("tasks/conditions/rate_noise.py", "x + level", "x - level", CODE),
    ("bench/engines/metrics/motion/overshoot.py", "max(value, sample", "min(value, sample", LOOPS),
    # the order of a named tuple's fields, which no byte code shows
    ("bench/engines/episode.py", "    kp: float\n    kv: float\n", "    kv: float\n    kp: float\n", CODE),
    # flags of the compiler
    ("bench/engines/compiled.py", '"error_model": "numpy"}', '"error_model": "python"}', CODE),
]
"""File, text, what is put in its place, and the functions that must be compiled again; all others must not."""


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of the sources."""
    folder = tmp_path_factory.mktemp("copy")
    for name in ("bench", "tasks"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


@pytest.fixture
def edited(copy):
    """edited(file, text): write a file of the copy, until the test ends."""
    before = {}

    def edit(name, text):
        path = copy / name
        before.setdefault(path, path.read_bytes() if path.exists() else None)
        path.write_text(text, encoding="utf-8")

    yield edit
    for path, content in before.items():
        if content is None:
            path.unlink()
        else:
            path.write_bytes(content)


def read_stamps(copy, **variables):
    return json.loads(python("-c", STAMPS, cwd=copy, PYTHONPATH=str(copy), **NUMBA, **variables))


@pytest.fixture(scope="module")
def stamps(copy):
    return read_stamps(copy)


def list_changed(before, after):
    assert before.keys() == after.keys()
    return {name for name in before if before[name] != after[name]}


def test_another_process_and_another_place_find_the_same_stamps(copy, stamps):
    assert read_stamps(copy, PYTHONHASHSEED="1") == stamps
    assert read_stamps(ROOT) == stamps


def test_comments_docstrings_and_moved_lines_change_no_stamp(copy, stamps, edited):
    for name in HARMLESS:
        text = (copy / name).read_text(encoding="utf-8")
        changed = text.replace('"""', '"""A comma, here: ', 1)
        edited(name, f"# A comment.\n\n{changed}")
    assert list_changed(stamps, read_stamps(copy)) == set()


def replace_in(copy, edited, name, old, new):
    text = (copy / name).read_text(encoding="utf-8")
    assert old in text
    edited(name, text.replace(old, new))


def test_change_of_one_function_changes_its_stamp_alone(copy, stamps, edited):
    for change in LOCAL:
        replace_in(copy, edited, *change)
    # a law that is added is no law that others depend on
    folder = "bench/law/contenders/regulators"
    text = (copy / folder / "mrp.py").read_text(encoding="utf-8")
    edited(f"{folder}/another.py", text.replace('"mrp"', '"another"'))
    assert list_changed(stamps, read_stamps(copy)) == {"limiter", "mrp-memory", "deoxys"} | WIDE


@pytest.mark.parametrize(("name", "old", "new", "functions"), WIDER)
def test_change_of_code_changes_the_stamps_of_what_depends_on_it(copy, stamps, edited, name, old, new, functions):
    replace_in(copy, edited, name, old, new)
    assert list_changed(stamps, read_stamps(copy)) == functions | WIDE


PACKAGES = {"python": "3.11.7", "numba": "0.68.1", "mujoco": "3.17.0"}


@pytest.mark.parametrize("variable", ["NUMBA_OPT", "NUMBA_LOOP_VECTORIZE", "NUMBA_CPU_FEATURES", "GLIBC_TUNABLES"])
def test_variable_that_changes_arithmetic_changes_all_code(variable):
    assert describe_setting({variable: "1"}, PACKAGES) != describe_setting({}, PACKAGES)


def test_variable_that_changes_no_code_leaves_it():
    environment = {"NUMBA_CACHE_DIR": "elsewhere", "HOME": "elsewhere"}
    assert describe_setting(environment, PACKAGES) == describe_setting({}, PACKAGES)


@pytest.mark.parametrize("package", ["python", "numba", "llvmlite", "numpy", "mujoco"])
def test_other_version_of_a_package_changes_all_code(package):
    assert package in versions()
    assert describe_setting({}, versions() | {package: "0.0"}) != describe_setting({}, versions())


COMMAND = """
import json
from bench.engines import simulate
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Goal, Tuning
from bench.law.so3 import Rotation
identity = Rotation((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
turned = Rotation((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0))
rest = (0.0, 0.0, 0.0)
law = simulate.evaluation(find_contender("mrp-memory"))
u, memory, _ = law(turned, rest, Goal(identity, rest, rest), Tuning(100.0, 20.0, 1e9, 0.0), (0.3, 0.0, 0.0, 1.0))
print(json.dumps(u))
"""
"""The command of a law at 180 degrees."""


def command(copy, cache, **variables):
    """Return the command, and how many files of compiled code there are."""
    out = python("-c", COMMAND, cwd=copy, PYTHONPATH=str(copy), NUMBA_CACHE_DIR=str(cache), **NUMBA, **variables)
    return json.loads(out), len(list(cache.rglob("*.nbc")))


def test_kept_code_is_taken_again_only_where_it_is_the_same(copy, edited, tmp_path):
    first, files = command(copy, tmp_path)
    assert files == 1
    name = "bench/law/contenders/regulators/mrp.py"
    law = (copy / name).read_text(encoding="utf-8")
    edited(name, f"# A comment.\n{law}")
    assert command(copy, tmp_path) == (first, 1)
    name = "bench/law/contenders/regulators/mrp.py"
    old = "4.0 * gains.kp"
    assert old in law
    edited(name, law.replace(old, "8.0 * gains.kp"))
    stronger, files = command(copy, tmp_path)
    assert (stronger, files) == ([2.0 * number for number in first], 2)
    edited(name, law)
    assert command(copy, tmp_path) == (first, 2), "the code of before is still there"
    assert command(ROOT, tmp_path) == (first, 2), "another checkout with the same sources takes it too"
    assert command(copy, tmp_path, NUMBA_CPU_NAME="generic")[1] == 3, "another processor does not"


COVERED = """
import json, sys
from numba.core import bytecode, ir
from bench.base.provenance import ROOT
from bench.base.sources import reader
from bench.engines import compiled, dependencies, simulate
from bench.engines.metrics.registry import metrics_of
from bench.law.contenders.registry import find_contender

compiled_files, constants = set(), set()

class Seen(bytecode.FunctionIdentity):
    pass

from_function = bytecode.FunctionIdentity.from_function.__func__
def seen(cls, function):
    compiled_files.add(function.__code__.co_filename)
    return from_function(cls, function)
bytecode.FunctionIdentity.from_function = classmethod(seen)

for kind in (ir.Global, ir.FreeVar):
    def begin(self, *words, begin=kind.__init__, **more):
        begin(self, *words, **more)
        simple = isinstance(self.value, dependencies.SIMPLE)
        if simple:
            constants.add((self.loc.filename, self.name, dependencies.describe(self.value)))
    kind.__init__ = begin

walked, files = set(), set(dependencies.list_compiler_files())
stamp_of = dependencies.walk
def walk(function):
    reached = stamp_of(function)
    walked.update(reached.words)
    for module in reached.modules:
        files.update(reader().follow(module))
    return reached
dependencies.walk = walk

simulate.evaluation(find_contender("mrp-memory"))
simulate.compiled_loop("perturbed", tuple(metrics_of(on_arm=False)))
ours = tuple(str(ROOT / name) for name in ("bench", "tasks"))
uncovered = [name for name in compiled_files if name.startswith(ours) and name not in set(map(str, files))]
words = {word for word in walked}
by_engine = set(map(str, dependencies.list_compiler_files()))
unseen = [
    (name, word) for file, name, word in constants
    if file.startswith(ours) and f"{name}: {word}" not in words and file not in by_engine
]
print(json.dumps([len(compiled_files), len(constants), uncovered, unseen]))
"""
"""Compile, and note each function and constant that numba itself reads; which of them did the walk not come by?"""


def test_all_that_numba_reads_is_in_the_stamp(tmp_path):
    files, constants, uncovered, unseen = json.loads(python("-c", COVERED, NUMBA_CACHE_DIR=str(tmp_path), **NUMBA))
    assert files > 10
    assert constants > 30
    assert uncovered == []
    assert unseen == []


def test_the_longest_unused_goes_first(tmp_path):
    for age, name in enumerate(("newest", "middle", "oldest")):
        path = tmp_path / "folder" / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(b"0" * 100)
        os.utime(path, (1e9 - age, 1e9 - age))
    prune(tmp_path, most_bytes=300, cut_bytes=100)
    assert sorted(path.name for path in Path(tmp_path, "folder").iterdir()) == ["middle", "newest", "oldest"]
    prune(tmp_path, most_bytes=299, cut_bytes=200)
    assert sorted(path.name for path in Path(tmp_path, "folder").iterdir()) == ["middle", "newest"]
