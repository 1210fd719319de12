"""`doctor`: is this machine ready, and if not, what is the cure."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from importlib.metadata import distributions
from typing import Any

import rich_click as click
from click.exceptions import Exit
from rich.text import Text

import tasks
from bench.base.provenance import describe_project
from bench.cli.screen import console, examples, shown_path
from bench.engines.metrics.registry import metrics_of
from bench.experiments.request import Request
from bench.experiments.tables.schema import RESULTS
from bench.law.contenders import combinations
from bench.law.contenders.registry import all_contenders, papers_laws
from bench.law.control.registry import find_controller
from tasks.arm import arms
from tasks.contact import can_do
from tasks.errors import BadArm

PAIR = ("reference", "native")

CURE_INSTALL = "make setup (or: pip install --require-hashes -r requirements/base.txt)"


@click.command("doctor", epilog=examples("doctor"))
def COMMAND() -> None:
    """Check versions, compiler, engines, arms, rendering, results; say the cure. Exit code 1: a needed one is bad."""
    failed = 0
    for name, check in CHECKS.items():
        is_needed = name != "rendering"
        try:
            state, text = "ok", check()
        except Exception as error:  # whatever a check meets is its finding
            state, text = ("bad" if is_needed else "note"), f"{error}"
            failed += is_needed
        style = {"ok": "green", "bad": "red", "note": "yellow"}[state]
        console().print(Text.assemble((f"{state:4}", style), f" {name:10} {text}"), soft_wrap=True)
    if failed:
        raise Exit(1)


def _python() -> str:
    version = ".".join(map(str, sys.version_info[:3]))
    if not (3, 11) <= sys.version_info[:2] <= (3, 13):
        raise RuntimeError(f"{version}; needed: 3.11 to 3.13. Cure: make setup PYTHON=python3.12")
    return version


def _versions() -> str:
    lines = (line.partition(";")[0].strip() for line in describe_project()["dependencies"])
    pins = dict(line.split("==") for line in lines if "==" in line)
    found = {name: next((one.version for one in distributions(name=name)), "missing") for name in pins}
    wrong = [f"{name} {found[name]} (pinned: {wanted})" for name, wanted in pins.items() if found[name] != wanted]
    if wrong:
        raise RuntimeError(f"{', '.join(wrong)}. Cure: {CURE_INSTALL}")
    return f"{len(pins)} packages as pinned, mujoco {pins['mujoco']}, dm-control {pins['dm-control']}"


def _compiler() -> str:
    from bench.engines.cache import FOLDER
    from bench.engines.compiled import compile_on_demand
    from bench.engines.in_c import compiler
    from tasks.verdict import check_state

    FOLDER.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryFile(dir=FOLDER):
        pass  # compiled code can be kept there
    command = compiler() or "numba"
    if compile_on_demand(check_state)(2.0, 1.0) != 5:
        raise RuntimeError(f"{command} computes wrongly. Cure: {CURE_INSTALL}")
    size = sum(path.stat().st_size for path in FOLDER.parent.rglob("*") if path.is_file())
    return f"{command} compiles; cache {FOLDER} ({size / 1e6:.0f} MB; may be deleted at any time)"


def _equal(both: Iterable[Any], where: str, what: str) -> str:
    fast, slow = both
    if fast.tobytes() != slow.tobytes():
        raise RuntimeError(f"{where} the compiled engine and the dm_control loop differ. Cure: {CURE_INSTALL}")
    return f"{what} equal the dm_control loop bit for bit"


def _engines() -> str:
    from bench.engines.simulate import run

    given = papers_laws()[0], "free-body", tasks.start_set("paper")[:1], Request().limits(0.05), metrics_of(False)
    return _equal((run(engine, *given) for engine in PAIR), "", "50 ticks of the compiled engine")


def _arms() -> str:
    from bench.engines.simulate_arms import run_arm as run

    broken = [str(one) for one in arms().values() if isinstance(one, BadArm)]
    found = [one for one in arms().values() if not isinstance(one, BadArm)]
    if broken or not found:
        cure = "correct the file, or take it out of tasks/arms"
        raise RuntimeError(f"{'; '.join(broken) or 'there is none'}. Cure: {cure}")
    arm = next((one for one in found if one.name == "ur5e"), found[0])
    laws = {one.name: one for one in all_contenders()}
    [law] = combinations.on((f"{papers_laws()[0].name}@geometric+standard",), laws, arm.joints)
    starts = tasks.start_set("clear", 1, arm=arm.name)
    given = law, "arm-regulation", arm.name, starts, Request().limits(0.05), metrics_of(True)
    names = ", ".join(one.name for one in found)
    return _equal((run(engine, *given) for engine in PAIR), f"on {arm.name}", f"{names}: 50 ticks on {arm.name}")


def _contact() -> str:
    from bench.engines.simulate_contact import run_contact as run

    task, one = tasks.contact_task("surface-alignment"), find_controller("hybrid-base+inverse")
    able = [arm for arm in arms().values() if not isinstance(arm, BadArm) and can_do(task, arm)]
    if not able:
        raise RuntimeError("no arm has a site 'wrist'. Cure: add the site to an arm in tasks/arms")
    arm, pressing = able[-1], task._replace(horizon_s=0.15)  # it touches after 0.05 s
    [fast], [slow] = ([found.record for found in run(way, one, pressing, arm, task.trials(arm)[:1])] for way in PAIR)
    names = ", ".join(one.name for one in able)
    return _equal((fast, slow), "in contact", f"{names}: {len(fast)} ticks on {arm.name}")


def _rendering() -> str:
    code = "import mujoco; m = mujoco.MjModel.from_xml_string('<mujoco/>'); mujoco.Renderer(m, 8, 8).close()"
    for backend in (os.environ.get("MUJOCO_GL"), "egl", "osmesa"):
        if not backend or backend == "disable":  # the command line disables it where nobody names another
            continue
        environment = {**os.environ, "MUJOCO_GL": backend, "PYOPENGL_PLATFORM": backend}
        done = subprocess.run([sys.executable, "-P", "-c", code], env=environment, capture_output=True, timeout=120)
        if done.returncode == 0:
            return f"MUJOCO_GL={backend} works"
    raise RuntimeError(
        "no offscreen rendering; only new stills need it. Cure: apt install libegl1 (or libosmesa6), then MUJOCO_GL=egl"
    )


def _results() -> str:
    try:
        RESULTS.mkdir(exist_ok=True)
        with tempfile.TemporaryFile(dir=RESULTS):
            pass
    except OSError as error:
        cure = "give yourself the right to, or name another folder with --out"
        raise RuntimeError(f"{RESULTS} cannot be written ({error.strerror}). Cure: {cure}") from error
    runs = [path.parent for path in sorted(RESULTS.glob("*/plan.json"))]
    found = [run.name for run in runs if (run / "provenance.json").is_file()]
    return f"{shown_path(RESULTS)} is writable; finished runs: {', '.join(found) or 'none'}"


CHECKS = {
    one.__name__.removeprefix("_"): one
    for one in (_python, _versions, _compiler, _engines, _arms, _contact, _rendering, _results)
}
