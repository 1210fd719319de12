"""`doctor`: is this machine ready, and if not, what is the cure."""

import importlib.metadata
import os
import subprocess
import sys
import tempfile
import tomllib

import rich_click as click
from click.exceptions import Exit
from rich.text import Text

from bench.base.provenance import ROOT
from bench.cli.screen import console, examples, shown_path
from bench.experiments.tables.schema import RESULTS

CURE_INSTALL = "make setup (or: pip install --require-hashes -r requirements/base.txt)"


@click.command("doctor", epilog=examples("doctor"))
def COMMAND():
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
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    pins = dict(line.split("==") for line in project["dependencies"] if "==" in line)
    wrong = []
    for name, wanted in pins.items():
        wanted = wanted.split(";")[0].strip()
        try:
            found = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found = "missing"
        if found != wanted:
            wrong.append(f"{name} {found} (pinned: {wanted})")
    if wrong:
        raise RuntimeError(f"{', '.join(wrong)}. Cure: {CURE_INSTALL}")
    return f"{len(pins)} packages as pinned, mujoco {pins['mujoco']}, dm-control {pins['dm-control']}"


def _compiler() -> str:
    from bench.engines.cache import FOLDER, to_itself
    from bench.engines.compiled import compile_function, float64

    with to_itself():
        pass
    if compile_function(lambda x: 2.0 * x, float64(float64), cache=False)(21.0) != 42.0:
        raise RuntimeError(f"numba computes wrongly. Cure: {CURE_INSTALL}")
    size = sum(path.stat().st_size for path in FOLDER.parent.rglob("*") if path.is_file())
    return f"numba compiles; cache {FOLDER} ({size / 1e6:.0f} MB; may be deleted at any time)"


def _engines() -> str:
    import tasks
    from bench.engines.metrics.registry import metrics_of
    from bench.engines.simulate import run
    from bench.experiments.experiment import Settings
    from bench.law.contenders.registry import papers_laws

    law = papers_laws()[0]
    metrics = metrics_of(on_arm=False)
    starts = tasks.start_set("paper")[:1]
    settings = Settings().limits(0.05)
    both = [run(engine, law, "free-body", starts, settings, metrics) for engine in ("reference", "native")]
    _check_equal(both, "the compiled engine")
    return "50 ticks of the compiled engine equal the dm_control loop bit for bit"


def _check_equal(both, where: str) -> None:
    fast, slow = both
    if fast.tobytes() != slow.tobytes():
        raise RuntimeError(f"{where} and the dm_control loop differ. Cure: {CURE_INSTALL}")


def _arms() -> str:
    import tasks
    from bench.engines.metrics.registry import metrics_of
    from bench.engines.simulate_arms import run_arm as run
    from bench.experiments.experiment import Settings
    from bench.law.contenders import combinations
    from bench.law.contenders.registry import all_contenders, papers_laws
    from tasks.arm import arms
    from tasks.errors import BadArm

    broken = [str(one) for one in arms().values() if isinstance(one, BadArm)]
    found = [one for one in arms().values() if not isinstance(one, BadArm)]
    if broken or not found:
        raise RuntimeError(
            f"{'; '.join(broken) or 'there is none'}. Cure: correct the file, or take it out of tasks/arms"
        )
    arm = next((one for one in found if one.name == "ur5e"), found[0])
    laws = {one.name: one for one in all_contenders()}
    [law] = combinations.on((f"{papers_laws()[0].name}@geometric+standard",), laws, arm.joints)
    metrics, settings = metrics_of(on_arm=True), Settings().limits(0.05)
    starts = tasks.start_set("clear", 1, arm=arm.name)
    both = [
        run(engine, law, "arm-regulation", arm.name, starts, settings, metrics) for engine in ("reference", "native")
    ]
    _check_equal(both, f"on {arm.name} the compiled engine")
    return f"{', '.join(one.name for one in found)}: 50 ticks on {arm.name} equal the dm_control loop bit for bit"


def _contact() -> str:
    import tasks
    from bench.engines.simulate_contact import run_contact as run
    from bench.experiments.contact import can_do
    from bench.law.control.registry import find_controller
    from tasks.arm import arms
    from tasks.errors import BadArm

    task, one = tasks.contact_task("surface-alignment"), find_controller("hybrid-base+inverse")
    able = [arm for arm in arms().values() if not isinstance(arm, BadArm) and can_do(task, arm)]
    if not able:
        raise RuntimeError("no arm has a site 'wrist'. Cure: add the site to an arm in tasks/arms")
    arm, pressing = able[-1], task._replace(horizon_s=0.15)  # it touches after 0.05 s
    given = (pressing, arm, task.trials(arm)[:1])
    [fast], [slow] = ([one.record for one in run(engine, one, *given)] for engine in ("native", "reference"))
    _check_equal((fast, slow), "in contact the compiled engine")
    return (
        f"{', '.join(one.name for one in able)}: {len(fast)} ticks on {arm.name} equal the dm_control loop bit for bit"
    )


def _rendering() -> str:
    code = "import mujoco; m = mujoco.MjModel.from_xml_string('<mujoco/>'); mujoco.Renderer(m, 8, 8).close()"
    for backend in filter(None, (os.environ.get("MUJOCO_GL"), "egl", "osmesa")):
        environment = {**os.environ, "MUJOCO_GL": backend, "PYOPENGL_PLATFORM": backend}
        done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, timeout=120)
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
    "python": _python,
    "versions": _versions,
    "compiler": _compiler,
    "engines": _engines,
    "arms": _arms,
    "contact": _contact,
    "rendering": _rendering,
    "results": _results,
}
