"""`map`: millions of random starts of a law, counted in cells of SO(3)."""

from pathlib import Path
from typing import Any

import rich_click as click
from click.exceptions import Exit

from bench.base.provenance import read_provenance
from bench.cli import options
from bench.cli.progress import progress
from bench.cli.screen import console, counted, examples, frame_table, shown_path
from bench.experiments.experiment import Unit
from bench.experiments.map import plan_of
from bench.experiments.request import check_numbers, check_workers
from bench.experiments.tables.schema import RESULTS
from bench.law.inputs import Gains
from bench.running.schedulers import check_scheduler

STARTS, SPEED = (
    options.NumberOption(1, 10**10, 10**7, is_whole=True),
    options.NumberOption(0.0, 100.0, 1),
)
ENGINE = click.Choice(["ideal-rk4", "ideal-held"])


@click.command("map", epilog=examples("map"))
@options.law
@options.regulator
@options.valued("--starts", 10**7, "Of each law.", type=STARTS)
@options.valued(
    "--spin", 0.0, "Initial speeds in rad/s are uniform up to this, directions uniform on the sphere.", type=SPEED
)
@click.option(
    "--speed",
    "stated",
    type=SPEED,
    multiple=True,
    help="Initial speed in rad/s of every start, in place of --spin; repeat it for a map of each.",
)
@options.valued("--engine", "ideal-rk4", "Continuous plant, or one sampled with a held command.", type=ENGINE)
@options.simulated
@options.valued("--horizon", 10.0, "Longest simulated time in seconds.", "horizon_s", type=options.HORIZON)
@options.carried_out
@options.valued("--out", RESULTS / "latest-map", "Folder.", type=options.PATH, show_default="results/latest-map")
def COMMAND(
    laws: options.Files, regulators: options.Words, starts: int, seed: int, spin: float, stated: tuple[float, ...],
    engine: str, dt_s: float, horizon_s: float, kp: float, kv: float, workers: int, scheduler: str, out: Path,
    replace: bool,
) -> None:  # fmt: skip
    """Simulate millions of uniformly random starts of a law on the ideal plant and count those that do not settle.

    Kept are counts by cell of SO(3), the slowest start of each 5 degrees of initial angle, and the first thousand
    starts that are lost or do not converge, never a row for each. A map that was stopped goes on where it was; threads
    and a cluster write the same bytes.
    """
    check_numbers(dt_s, horizon_s, Gains(kp, kv), None, seed)
    check_workers(workers)
    check_scheduler(scheduler)
    from bench.running import run as running  # numba takes seconds; mistakes should not

    chosen = [one for one in options.chosen(laws, regulators, ()) if not one.regulator.in_engine]
    if not chosen:
        raise click.UsageError("the ideal plant has no actuator of MuJoCo; name another --regulator")
    if spin and stated:
        raise click.UsageError("--spin draws speeds and --speed states them (give one of the two)")
    speeds = tuple((speed, speed) for speed in dict.fromkeys(stated)) or ((0.0, spin),)
    numbers: dict[str, Any] = {"dt_s": dt_s, "horizon_s": horizon_s, "gains": Gains(kp, kv)}
    plan = plan_of(chosen, starts, seed=seed, speeds=speeds, engine=engine, **numbers)
    console().print(f"{counted(len(chosen), 'law')} from {starts:,} starts, into {shown_path(out)}")
    done = 0
    with progress("starts") as steps:

        def report(unit: Unit) -> None:
            nonlocal done
            done += unit.episodes
            steps.now(unit.label, done, plan.episodes())

        steps.now("compiling the laws")
        running.run(plan, out, workers=workers, scheduler=scheduler, replace=replace, report=report)
    from bench.experiments.tables.store import read
    from bench.findings.maps import by_law

    digits = {**dict.fromkeys(("lost [ppm]", "least [ppm]", "most [ppm]"), 2), "slowest [s]": 3}
    title = "Starts that are lost, of those that converge; least and most: exact 95 % interval (Clopper-Pearson)"
    console().print(frame_table(by_law(read(out, "map")).round(digits), f"\n{title}"))
    console().print(f"in {shown_path(out)}")
    if read_provenance(out)["lost"]:
        raise Exit(1)  # a law of the user's crashed or hung: what was lost has been said
