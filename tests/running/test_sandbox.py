"""A user's law that raises, exits, hangs or is no law at all in some states costs its own rows, never the run."""

import dataclasses
import textwrap
import time

import psutil
import pytest
from support.command_line import refused, started
from support.user_law import plan_of, spring_text

from bench.base.errors import BadLaw
from bench.experiments import plan as planning
from bench.experiments.experiment import experiment_of
from bench.experiments.plan import Plan
from bench.experiments.request import Request
from bench.experiments.tables import store
from bench.experiments.tables.packed import unpack
from bench.law.contender import Contender
from bench.law.contenders.described_law import described
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import contenders_of
from bench.running import run, sandbox, sandbox_process
from bench.running.wire_format import described as described_plan

LIMIT_S = 1.0


def test_unit_gives_up_after_some_lost_episodes(tmp_path):
    plan = plan_of(tmp_path, "if R.n[0] < 2.0 and omega[0] == 0.0: os._exit(3)", engine="reference")
    [unit] = (one for one in plan.units if one.law == "mine")
    with sandbox.Sandbox(plan, LIMIT_S, most_lost=1) as kept:
        assert kept.rows(unit).column("outcome").to_pylist() == ["crashed"] * 4


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


def test_process_of_a_law_ends_with_the_run(tmp_path):
    """Also when the law never would: here it hangs in compiled code while the run is killed."""
    script = """
        import sys
        from pathlib import Path
        from support.user_law import plan_of
        from bench.running.sandbox import Sandbox
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
    with sandbox.Sandbox(plan) as kept, pytest.raises(BadLaw, match=f"--law {tmp_path / 'mine.py'}: the law cannot be"):
        kept.check()


def test_answer_of_the_process_is_the_rows_that_a_thread_makes(tmp_path):
    plan = plan_of(tmp_path, "pass", engine="ideal-rk4")
    unit = next(one for one in plan.units if one.contender == "mine")
    loaded = (Contender(load_law(tmp_path / "mine.py")),)
    here = Plan(dataclasses.replace(plan.request, laws=loaded), plan.units)
    content = sandbox_process.answer(lambda: sandbox_process.made(here, unit.part(1, 2)))
    assert content[:1] == sandbox_process.DONE
    assert unpack(content[1:], experiment_of(unit).table).column("start_id").to_pylist() == [
        "uniform-00001",
        "uniform-00002",
    ]
    assert described_plan(plan, [unit])["settings"]["own"]
