"""A user's law that raises, exits, hangs or is no law at all in some states costs its own rows, never the run."""

import dataclasses
import textwrap
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pandas as pd
import psutil
import pytest
from support.command_line import refused, started
from support.user_law import plan_of, spring_text

import tasks
from bench.base.errors import BadLaw
from bench.base.provenance import read_provenance
from bench.experiments import plan as planning
from bench.experiments.experiment import experiment_of
from bench.experiments.plan import Plan
from bench.experiments.request import Request
from bench.experiments.tables import store
from bench.experiments.tables.packed import unpack
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of
from bench.running import run
from bench.running.sandbox import sandbox, server
from bench.running.wire_format import described as described_plan
from tasks.rotations import columns
from tasks.verdict import CRASHED, HUNG, OUTCOMES

LIMIT_S = 1.0

HANGS = "while {condition}: x = x + 1e-9"
"""A line of a law that never returns from a state."""


def plan_of_many(folder: Path, condition: str, count: int) -> Plan:
    """Plan a law that hangs in such states, and the same law without it, from `count` starts each."""
    laws = []
    for name, line in (("mine", HANGS.format(condition=condition)), ("sound", "pass")):
        path = folder / f"{name}.py"
        path.write_text(spring_text(line, name=name))
        laws += contenders_of(described(path))
    words = {"tasks": ("free-body",), "start_sets": ("uniform",), "engines": ("ideal-rk4",)}
    request = Request("quick", tuple(laws), count=count, horizon_s=0.05, **words)
    return planning.make(dataclasses.replace(request, experiments=("free-body",)))


def rows_of_laws(plan: Plan) -> tuple[dict, list[str]]:
    """Return the rows of each law, without its name, and what is said of the laws."""
    with sandbox.Sandbox(plan, LIMIT_S) as box:
        rows = {unit.law: box.rows(unit).to_pandas().drop(columns="regulator") for unit in plan.units}
        return rows, box.notes


def beginning(number: int) -> float:
    """Return R.n[0] of a start of the set `uniform`."""
    return columns(tasks.start_set("uniform", number + 1)[number].quat_wxyz)[0][0]


def test_law_that_hangs_from_one_start_loses_25_rows_and_the_others_are_equal(tmp_path):
    count = 60
    rows, notes = rows_of_laws(plan_of_many(tmp_path, f"abs(R.n[0] - ({beginning(30)!r})) < 1e-9", count))
    hung = rows["mine"]["outcome"].astype(str) == "hung"
    assert list(hung) == [25 <= number < 50 for number in range(count)]
    pd.testing.assert_frame_equal(rows["mine"][~hung].astype(object), rows["sound"][~hung].astype(object))
    [note] = notes
    assert note.startswith("ideal-rk4 mine, uniform from 25: it did not return within 1 s of processor time")
    assert note.endswith("its 25 episodes are hung")


def test_law_that_never_returns_is_given_up_after_three_losses_and_this_is_said_once(tmp_path):
    rows, notes = rows_of_laws(plan_of_many(tmp_path, "abs(R.n[0] - 0.36) > 1e-9", 25 * 20))
    assert set(rows["mine"]["outcome"]) == {"hung"}
    assert len(rows["mine"]) == len(rows["sound"]) == 25 * 20
    assert "hung" not in set(rows["sound"]["outcome"])
    assert len(notes) == sandbox.MOST_LOST + 1
    assert notes[-1] == "mine: it was lost 3 times; its other episodes count as hung and are not tried"


def test_perturbed_law_that_hangs_loses_the_whole_unit(tmp_path):
    path = tmp_path / "own.py"
    path.write_text(spring_text("while R.n[0] < -0.1: x = x + 1e-9"))
    laws = tuple(contenders_of(described(path)))
    words = {"axes": ("delay", "spin"), "experiments": ("robustness",)}
    plan = planning.make(Request("quick", laws, count=3, horizon_s=0.05, **words))
    run.run(plan, tmp_path / "run", workers=1, law_limit_s=LIMIT_S)
    rows = store.read(tmp_path / "run", "robustness")
    assert len(rows) == plan.episodes()
    assert set(rows["outcome"]) == {"hung"}
    assert rows[["final_angle_rad", "tail_rms_rad", "peak_u", "variation"]].isna().all(axis=None)


STRIKE = (
    "if 'running/sandbox' in sys.argv[0] and len(os.listdir({struck!r})) < {most}: "
    "open(os.path.join({struck!r}, str(time.time_ns())), 'w').close(); {deed}"
)
"""What a law does in its first calls in a process that makes rows."""
SIGKILL = "os.kill(os.getpid(), 9)"
LATER = "; the same command tries them again"


def plan_that_strikes(folder: Path, deed: str, most: int, count: int = 4) -> Plan:
    """Plan a law on the engine in Python that does the deed so many times, and is sound then."""
    struck = folder / "struck"
    struck.mkdir()
    return plan_of(folder, STRIKE.format(struck=str(struck), most=most, deed=deed), engine="reference", count=count)


@pytest.mark.parametrize("deed", [SIGKILL, "os.kill(os.getppid(), 9); time.sleep(9)"])
def test_law_whose_process_is_killed_is_tried_once_more_and_then_by_the_same_command(tmp_path, deed):
    """Here it is killed twice by the first command, and once by the second, which loses nothing."""
    plan, out = plan_that_strikes(tmp_path, deed, most=3), tmp_path / "run"
    run.run(plan, out, workers=1)
    about = read_provenance(out)
    assert about["again"] == [plan.units[-1].key]
    assert about["lost"][0].endswith(f": it ended its process, SIGKILL; its 4 episodes are crashed{LATER}")
    run.run(plan, out, workers=1)
    assert read_provenance(out)["lost"] == []
    assert set(store.read(out, "episodes")["outcome"]) == {"timed-out"}


@pytest.mark.parametrize(("deed", "later"), [(SIGKILL, LATER), ("os._exit(0)", "")])
def test_threads_that_lose_units_of_a_law_at_once_give_it_up_once(tmp_path, deed, later):
    plan = plan_that_strikes(tmp_path, deed, most=99, count=20)
    with sandbox.Sandbox(plan) as box, ThreadPoolExecutor(4) as threads:
        is_made = [content is not None for content in threads.map(box.packed, plan.units)]
    assert is_made == [not (later and box.has(unit)) for unit in plan.units]
    assert [note for note in box.notes if "3 times" in note] == [
        f"mine: it was lost 3 times; its other episodes count as crashed and are not tried{later}"
    ]


def test_process_of_a_law_ends_with_the_run(tmp_path):
    """Also when the law never would: here it hangs in compiled code while the run is killed."""
    script = """
        import sys
        from pathlib import Path
        from support.user_law import plan_of
        from bench.running.sandbox.sandbox import Sandbox
        plan = plan_of(Path(sys.argv[1]), "while abs(R.n[0] - 0.36) > 1e-3: x = x + 1e-9", engine="reference")
        Sandbox(plan).rows(plan.units[-1])
    """
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with started("-c", textwrap.dedent(script), tmp_path, variables={"TMPDIR": temporary}) as process:
        own, children, begun = psutil.Process(process.pid), [], time.monotonic()
        while len(children) < 3:  # the law's process, its guard, and the fork in which it hangs
            assert time.monotonic() - begun < 120.0
            time.sleep(0.05)
            children = own.children(recursive=True)
        [of_the_law] = temporary.glob("orientation-bench-law-*")
        process.kill()
    _, alive = psutil.wait_procs(children, timeout=60)
    assert alive == []
    assert not of_the_law.exists()


def test_limit_must_be_positive(capsys, tmp_path):
    assert "law-limit" in refused(capsys, "run", "--law-limit", "0", "--out", tmp_path / "run")


def test_mistake_in_a_law_names_the_users_file(tmp_path):
    plan = plan_of(tmp_path, "x = float(str(x))", engine="ideal-rk4")
    with sandbox.Sandbox(plan) as box, pytest.raises(BadLaw, match=f"--law {tmp_path / 'mine.py'}: the law cannot be"):
        box.check()


def test_answer_of_the_process_is_the_rows_that_a_thread_makes(tmp_path):
    plan = plan_of(tmp_path, "pass", engine="ideal-rk4")
    unit = next(unit for unit in plan.units if unit.contender == "mine")
    serving = server.UnitServer()
    serving.load(described_plan(plan, [unit]))
    content = serving.answer({"key": unit.key, "starts": (1, 2), "in_fork": True}, None)
    assert unpack(content, experiment_of(unit).table).column("start_id").to_pylist() == [
        "uniform-00001",
        "uniform-00002",
    ]


def test_outcomes_of_lost_episodes_are_words_of_the_judge():
    assert (OUTCOMES[CRASHED], OUTCOMES[HUNG]) == sandbox.LOST
