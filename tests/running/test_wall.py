"""A user's law changes no other law's rows: not in its run, not in the next, with no code compiled before or with all.

The laws here poison what numba would keep, or hold a lock on it, when their files are imported. All of them take part
in one run. The test itself holds a lock on the folder of compiled code all the time, as a run that was stopped might.
"""

import contextlib
import fcntl
import os
from pathlib import Path

import pytest
from support.command_line import python
from support.user_law import spring_text

from bench.experiments.tables import store

OURS = ("rotation-matrix", "square-root")
ASKED = (
    *("--task", "free-body", "--experiment", "free-body", "--engine", "ideal-rk4"),
    *("--starts", "half-turn", "--starts", "uniform", "--count", "6"),
    *(word for law in OURS for word in ("--regulator", law)),
)

POISONS = {
    "swaps-outcomes": """
import tasks.verdict
tasks.verdict.SETTLED, tasks.verdict.STUCK = tasks.verdict.STUCK, tasks.verdict.SETTLED
""",
    "changes-numbers": """
import bench.law.scalar, bench.law.so3, tasks.rules, tasks.truth, tasks.verdict
for module in (bench.law.scalar, bench.law.so3, tasks.rules, tasks.truth, tasks.verdict):
    for name, value in list(vars(module).items()):
        if type(value) is float:
            setattr(module, name, 2.0 * value)
tasks.rules.RULES = tasks.rules.RULES._replace(tolerance=0.9)
""",
    "moves-the-cache": """
import os
os.environ["NUMBA_CACHE_DIR"] = os.path.join(os.environ["NUMBA_CACHE_DIR"], "..", "cache")
import numba.core.caching
numba.core.caching.IndexDataCacheFile.load = lambda self, key: None
import tasks.verdict
tasks.verdict.SETTLED = tasks.verdict.STUCK
""",
    "holds-locks": """
import fcntl, os
held = []
for folder, _, files in os.walk(os.environ["NUMBA_CACHE_DIR"]):
    for path in (folder, *(os.path.join(folder, file) for file in files)):
        held.append(os.open(path, os.O_RDONLY))
        try:
            fcntl.flock(held[-1], fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            pass
""",
}
"""Name -> what the file of the law does before it defines a sound law."""


def run(folder: Path, cache: Path, laws: tuple[Path, ...] = (), code: int = 0) -> str:
    """Return the rows of our laws as text, which is equal if and only if every number is."""
    files = [word for path in laws for word in ("--law", path)]
    python("-m", "bench", "run", *ASKED, *files, "--out", folder, code=code, NUMBA_CACHE_DIR=str(cache))
    episodes = store.read(folder, "episodes")
    made = set(episodes["regulator"].astype(str))
    assert made == {*OURS, *(path.stem for path in laws)}
    return episodes[episodes["regulator"].isin(OURS)].to_csv(index=False)


@contextlib.contextmanager
def locked(folder: Path):
    """Hold the lock of a folder."""
    folder.mkdir(exist_ok=True)
    handle = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


@pytest.fixture(scope="module")
def poisoned(tmp_path_factory) -> tuple[Path, ...]:
    """The files of the laws."""
    folder = tmp_path_factory.mktemp("laws")
    for name, lines in POISONS.items():
        (folder / f"{name}.py").write_text(lines + spring_text(name=name))
    return tuple(sorted(folder.iterdir()))


@pytest.fixture(scope="module")
def clean(tmp_path_factory) -> tuple[str, Path]:
    """Our laws alone, and the folder of what was compiled."""
    folder = tmp_path_factory.mktemp("clean")
    return run(folder / "run", folder / "cache"), folder / "cache"


@pytest.mark.parametrize("state", ["cold", "warm"])
def test_rows_of_others_are_equal_beside_laws_that_poison_or_lock_and_in_the_next_run(
    tmp_path, clean, poisoned, state
):
    alone, compiled = clean
    cache = compiled if state == "warm" else tmp_path / "cache"
    with locked(cache):
        # 1: the rows of `changes-numbers` say other rules than the judge's, so they count as crashed
        beside = run(tmp_path / "beside", cache, poisoned, code=1)
        after = run(tmp_path / "after", cache)
    assert beside == alone
    assert after == alone


def test_loops_that_only_a_users_law_needs_are_compiled_and_kept_without_it(tmp_path, clean, poisoned):
    """Else each of its processes would compile them again, for seconds: it keeps nothing itself.

    This law changes the judge in its own processes, which therefore take none of the kept code; its rows are refused.
    """
    law, cache = poisoned[-1], tmp_path / "cache"
    without_ours = ASKED[: ASKED.index("--regulator")]
    words = ("--law", law, "--regulator", law.stem, "--out", tmp_path / "run")
    python("-m", "bench", "run", *without_ours, *words, code=1, NUMBA_CACHE_DIR=str(cache))
    of_ours, of_users = ({path.name for path in folder.glob("c/*.so")} for folder in (clean[1], cache))
    loops = len(of_ours) - len(OURS)  # each law of ours has a library, too
    assert loops > 0
    assert len(of_ours & of_users) >= loops
