"""`history`: what every build measured; add a build, look for steps."""

import os
import subprocess
from pathlib import Path

import rich_click as click

from bench.cli.progress import progress
from bench.cli.screen import console, examples, frame_table
from bench.errors import BadResults
from bench.provenance import ROOT
from bench.tables.schema import RESULTS

EPILOG = examples(("What writes a comparison", "compare main --json comparison.json"))
SIDES = ("head", "base")
book = click.option(
    "--file",
    "path",
    type=click.Path(path_type=Path),
    default=RESULTS / "history" / "history.jsonl",
    show_default="results/history/history.jsonl",
    metavar="FILE",
    help="The history.",
)


@click.group("history", epilog=EPILOG)
def COMMAND():
    """What every build measured, a line a benchmark, and where it changed."""


@COMMAND.command("add")
@click.argument("comparisons", nargs=-1, type=click.Path(path_type=Path), metavar="[COMPARISON]...")
@click.option("--side", "sides", multiple=True, type=click.Choice(SIDES), help="Of a comparison; head by default.")
@book
def add(comparisons, sides, path):
    """Measure this checkout and append a line for each law and engine; or append what comparisons measured.

    A build that this machine has measured before adds nothing.
    """
    from bench.regression.history import log, record
    from bench.regression.revisions import comparison, self_measure

    if comparisons:
        given = [(one, side) for one in map(comparison.read, comparisons) for side in sides or SIDES[:1]]
        lines = [new for one, side in given for new in record.of_comparison(one, side, commit_of)]
    else:
        commit_of("HEAD")  # a clone that cannot say is refused before the minutes that measuring takes
        with progress("steps") as steps:
            measured = self_measure.measure(steps.now)
        lines = record.of_self_measure(measured, commit_of)
        if measured.uncounted:
            console().print(measured.uncounted)
    console().print(f"{log.append(lines, path)} of {len(lines)} lines are new: {path}")


@COMMAND.command("merge")
@click.argument("histories", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="HISTORY...")
@book
def merge(histories, path):
    """Append the lines of other histories: of another machine, or of a branch that keeps them."""
    from bench.regression.history import log

    for one in histories:
        if not one.is_file():
            raise BadResults(f"{one}: there is no such file; give a history, as results/history/history.jsonl")
    lines = [line for one in histories for line in log.read(one)]
    console().print(f"{log.append(lines, path)} of {len(lines)} lines are new: {path}")


@COMMAND.command("show")
@book
def show(path):
    """The builds, and every step: what changed, from which commit on, by how much."""
    import pandas as pd

    from bench.regression.history import log
    from bench.regression.history.series import series
    from bench.regression.history.steps import steps

    lines = log.read(path)
    if not lines:
        raise BadResults("the history is empty; add a build to it (try: python -m bench history add --help)")
    builds = pd.DataFrame(
        [(record.date, record.commit[:10], record.machine, record.benchmark.name) for record in lines],
        columns=["date", "commit", "machine", "benchmarks"],
    )
    counted = builds.groupby(["date", "commit", "machine"], sort=False)["benchmarks"].count().reset_index()
    console().print(frame_table(counted, "Builds"))
    every = series(lines)
    places = {record.commit: record.place for record in lines}
    found = sorted((step for one in every for step in steps(one)), key=lambda step: places[step.point.commit])
    table = pd.DataFrame(
        [
            (step.point.date[:10], step.point.commit[:10], step.series.name, step.series.measure, step.says)
            for step in found
        ],
        columns=["date", "commit", "benchmark", "measure", "what changed"],
    )
    console().print(frame_table(table, f"\nSteps: {len(found)} in {len(every)} series"))


def commit_of(name: str):
    """A commit of this checkout: when it was made, UTC, and how many lead to it.

    Errors:
        BadResults: there is no such commit, or a clone without the history before it.
    """
    from bench.regression.history.record import Commit

    if _git("rev-parse", "--is-shallow-repository") == "true":
        raise BadResults("this clone lacks older commits, which order a history (cure: git fetch --unshallow)")
    date = _git("show", "-s", "--date=format-local:%Y-%m-%dT%H:%M:%SZ", "--format=%cd", name, "--")
    return Commit(name, date, int(_git("rev-list", "--count", name, "--")))


def _git(*words: str) -> str:
    try:
        said = subprocess.run(
            ["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=True, env=os.environ | {"TZ": "UTC"}
        )
    except (OSError, subprocess.CalledProcessError) as error:
        raise BadResults(f"git {words[0]}: no such commit in this checkout (cure: git fetch)") from error
    return said.stdout.strip()
