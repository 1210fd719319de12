"""Compiled code that processes, threads and laws share; models as compiled loops step them: lean, without a clock."""

import json
import os
import subprocess
import sys
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import mujoco
import pytest
from numba.core.bytecode import FunctionIdentity
from support.bits import different_rows
from support.command_line import python
from support.driving import METRICS, settings, spread

import tasks
from bench.engines import simulate as engines
from bench.engines.cache import COMPILER_VARIABLE
from bench.engines.compiled import compile_once
from bench.engines.native.libmujoco import model_of, skip_constraints
from bench.law.contenders.registry import find_contender
from tasks.contact_model import model_xml


def test_threads_that_need_the_same_wait_for_the_first_to_make_it():
    made = []

    @compile_once
    def slowly(word):
        made.append(word)
        time.sleep(0.05)
        return [word]

    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(slowly, 4 * ["loop"]))
    assert made == ["loop"]
    assert all(one is found[0] for one in found)


@pytest.mark.parametrize("engine", ["ideal-rk4", "ideal-held", "native"])
def test_loop_of_one_law_runs_every_other(engine):
    """So that a law costs its own compilation, not that of a loop: it is made for no law, and has one signature."""
    loop = engines.compiled_loop(engine, METRICS)
    starts = spread(1)
    laws = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]
    one, other = (engines.run(engine, law, "free-body", starts, settings(horizon_s=0.5), METRICS) for law in laws)
    assert different_rows(one, other) != []
    assert engines.compiled_loop(engine, METRICS) is loop
    assert len(getattr(loop, "signatures", [loop])) == 1  # of numba's


LAWS = ("linearized-euler/zyx-euler", "linearized-euler-literal/zyx-euler")
"""One stabilizes the goal, the other leaves it; their compiled functions have the same names."""

ANGLES = """
import json, sys
from bench.law.inputs import Gains
from bench.law.contenders.registry import find_contender
from bench.engines.episode import FINAL_ANGLE, Settings
from bench.engines.simulate import run
from tasks import start_set
settings = Settings(Gains(), 1e-3, 500, 501, 1e6, 1e4, 1e-3, 1e-2)
said = {}
for name in sys.argv[1:]:
    rows = run("ideal-rk4", find_contender(name), "free-body", start_set("paper"), settings, ())
    said[name] = rows[:, FINAL_ANGLE].tolist()
print(json.dumps(said))
"""


def angles(variables, *laws):
    """Final angles of laws, in a process of their own."""
    return json.loads(python("-c", ANGLES, *laws, **variables))


@pytest.mark.parametrize("compiler", ["cc", "numba"])
def test_laws_compiled_by_two_processes_at_once_do_not_mix_in_a_third(tmp_path, compiler):
    variables = {"NUMBA_CACHE_DIR": str(tmp_path), COMPILER_VARIABLE: compiler}
    environment = {**os.environ, **variables}
    at_once = [
        subprocess.Popen([sys.executable, "-c", ANGLES, law], env=environment, stdout=subprocess.PIPE, text=True)
        for law in LAWS
    ]
    alone = {}
    for process in at_once:
        alone |= json.loads(process.communicate()[0])
    assert angles(variables, *LAWS) == alone
    assert angles(variables, *reversed(LAWS)) == alone


def test_fork_numbers_its_functions_from_another_place():
    """Or two children of one process would compile laws of one name and number, of which the linker keeps one."""
    reader, writer = os.pipe()
    with warnings.catch_warnings(action="ignore", category=DeprecationWarning):  # of threads
        child = os.fork()
    if not child:
        os.write(writer, str(next(FunctionIdentity._unique_ids)).encode())
        os._exit(0)
    os.waitpid(child, 0)
    assert abs(int(os.read(reader, 100)) - next(FunctionIdentity._unique_ids)) > 10**6


@pytest.mark.parametrize("arm", tasks.arm_names())
def test_has_no_geom_that_cannot_touch(arm):
    assert mujoco.MjModel.from_xml_string(tasks.task("arm-regulation", arm).xml(1e-3)).ngeom > 0
    assert model_of(tasks.task("arm-regulation", arm).xml(1e-3), "euler").ngeom == 0


@pytest.mark.parametrize("name", tasks.contact_names())
def test_keeps_every_geom_that_can_touch(name):
    xml = model_xml(tasks.contact_task(name), tasks.arm("ur5e"), 1e-3)
    whole, lean = mujoco.MjModel.from_xml_string(xml), model_of(xml, "implicitfast")
    touching, kept = (
        sorted(one.geom(i).size.tolist() for i in (*one.pair_geom1, *one.pair_geom2)) for one in (whole, lean)
    )
    assert kept == touching
    assert lean.ngeom < whole.ngeom


@pytest.mark.parametrize(("variation", "skips"), [("ideal-motors", True), ("nominal", False), ("friction-5", False)])
def test_constraints_are_skipped_only_where_a_model_has_none(variation, skips):
    arm = tasks.arm("ur5e")
    model = model_of(tasks.task("arm-regulation", "ur5e").xml(1e-3), "euler")
    tasks.variation(variation).apply(model, arm.rated)
    assert bool(skip_constraints(model).opt.disableflags & mujoco.mjtDisableBit.mjDSBL_CONSTRAINT) == skips
    pressed = model_of(model_xml(tasks.contact_task("surface-alignment"), arm, 1e-3), "implicitfast")
    assert not skip_constraints(pressed).opt.disableflags & mujoco.mjtDisableBit.mjDSBL_CONSTRAINT


def test_clock_is_not_asked():
    model = model_of(tasks.task("free-body").xml(1e-3), "euler")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data)
    assert [one.duration for one in data.timer] == [0.0] * len(data.timer)
