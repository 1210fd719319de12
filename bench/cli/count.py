"""`count`: operations a tick, from the code that runs."""

from __future__ import annotations

import rich_click as click
from click.exceptions import Exit

import tasks
from bench.base.errors import Incompatible
from bench.base.on_first_use import pd
from bench.cli import options
from bench.cli.progress import progress
from bench.cli.screen import console, examples, frame_table
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.plan import Plan
from bench.experiments.request import Request
from bench.experiments.suites import BY_WORD_ALONE, SUITES
from bench.law.contender import Contender
from bench.law.contenders import combinations
from bench.law.control.registry import find_controller


@click.command("count", epilog=examples("count"))
@options.law
@options.regulator
@options.representation
@options.jacobian
@options.inverse
@options.controller
@click.option("--joints", type=click.Choice(["6", "7"]), help="Joints of the arm (default: 6).")
@click.option("--stages", is_flag=True, help="A line for each stage of the tick, not only the total.")
def COMMAND(
    laws: options.Files, representations: options.Words, controllers: options.Words, joints: str | None, stages: bool,
    **words: options.Words,
) -> None:  # fmt: skip
    """Count the operations of each law per tick: typical and worst branch, transcendental functions apart.

    --law FILE: count this law and any law given with --regulator.

    A Jacobian, an inverse or a number of joints: count the whole controller of an arm, without what MuJoCo
    computes, for every Jacobian and inverse that fits unless one is named. --controller NAME: count it in contact, on
    six joints, compliant about x and y.
    """
    if controllers:
        if laws or representations or joints or any(words.values()):
            raise click.UsageError("--controller is counted alone (leave out all other options but --stages)")
        from bench.engines.counting.in_contact import rows_in_contact

        rows = [row for word in dict.fromkeys(controllers) for row in rows_in_contact(find_controller(word))]
        _print(pd.DataFrame(rows), "Operations per tick of a controller in contact", stages)
        return
    named = options.named(**words)
    alone = named.pop("regulators") or tuple(one.name for one in options.own_laws(laws))
    chosen = options.chosen(laws, alone, representations, costings=True)
    if joints or any(named.values()):
        n = int(joints or 6)
        arm = next(name for name in tasks.arm_names() if tasks.arm(name).joints == n)  # nothing else of it counts
        table = _rows(_controllers(chosen, named, n), arm)
        title = f"Operations per tick of a controller of {n} joints"
    else:
        table = _rows(chosen).drop(columns=["jacobian", "inverse"])
        title = "Operations per tick"
    _print(table.drop(columns="joints"), title, stages)


def _rows(chosen: list[Contender], arm: str = "") -> pd.DataFrame:
    """Rows of costs.parquet: of laws alone, or on an arm; a user's are counted in their sandbox."""
    from bench.running.sandbox.sandbox import Sandbox

    plan = Plan(Request(laws=tuple(chosen)), tuple(Unit("costs", one.name, arm=arm) for one in chosen))
    with Sandbox(plan) as sandbox, progress("laws", "counting"):
        sandbox.check()
        made = [
            sandbox.rows(unit).to_pandas() if sandbox.has(unit) else rows_of(plan.request, unit) for unit in plan.units
        ]
        if sandbox.notes:
            raise Exit(1)
    return pd.concat(made, ignore_index=True)


def _print(table: pd.DataFrame, title: str, stages: bool) -> None:
    if not stages:
        table = table[table["stage"] == "total"].drop(columns="stage")
    console().print(frame_table(table.loc[:, (table != 0).any()], title))


def _controllers(laws: list[Contender], named: dict[str, options.Words], joints: int) -> list[Contender]:
    """Return the controllers of the laws by the Jacobians and inverses that are named; the quick suite's if none is."""
    by_name = {one.name: one for one in laws}
    from bench.experiments.arm import on_real_motors

    section = SUITES["quick"].sections["arm"]
    words = (*section["words"], *section["operational"]["words"], *on_real_motors(section))
    found = combinations.chosen(words, by_name, joints, named["jacobians"], named["inverses"], BY_WORD_ALONE)
    if not found:
        reasons = combinations.refusals(laws, joints, named["jacobians"], named["inverses"])
        raise Incompatible(f"nothing to count: {combinations.shown(reasons)}")
    return found
