"""`show`: a run's outcomes in one screen."""

from pathlib import Path

import rich_click as click

from bench.cli import options
from bench.cli.screen import console, frame_table
from bench.errors import BadResults
from bench.store import read, read_json
from tasks.verdict import OUTCOMES

ORIGIN = {"suite", "episodes", "commit", "dirty", "cpu", "wall_s"}
"""What the first line of the summary names."""


@click.command("show")
@click.argument("folder", required=False, type=click.Path(path_type=Path))
@click.option("--engine", help="Only this engine.")
@click.option("--starts", help="Only this start set.")
@options.regulator
def COMMAND(folder, engine, starts, regulators):
    """Summary of a run: outcomes and settling time by law and start set (default: results/latest)."""
    folder = folder or options.newest()
    episodes = read(folder, "episodes")
    for column, word in (("engine", engine), ("start_set", starts)):
        if word is not None:
            known = sorted(episodes[column].unique())
            if word not in known:
                raise click.UsageError(
                    f"{folder} has no {column.replace('_', ' ')} '{word}'; it has: {', '.join(known)}"
                )
            episodes = episodes[episodes[column] == word]
    if regulators:
        known = sorted(episodes["regulator"].unique())
        for word in regulators:
            if word not in known:
                raise click.UsageError(f"{folder} has no regulator '{word}'; it has: {', '.join(known)}")
        episodes = episodes[episodes["regulator"].isin(regulators)]
    origin = read_json(folder / "provenance.json")
    lacking = ", ".join(sorted(ORIGIN - origin.keys()))
    if lacking:
        raise BadResults(f"{folder / 'provenance.json'}: it lacks {lacking}; delete the folder and run again")
    console().print(
        f"{folder}: suite {origin['suite']}, {origin['episodes']:,} episodes, commit {origin['commit'][:10] or 'none'}"
        f"{' with changes' if origin['dirty'] else ''}, {origin['cpu']}, {origin['wall_s']} s"
    )
    for name, part in episodes.groupby("engine", observed=True, sort=False):
        console().print(frame_table(summary(part), f"\n{name}"))


def summary(episodes):
    """One line for each start set and law: counts of outcomes, then median and worst settling time [s]."""
    keys = ["start_set", "regulator", "representation"]
    grouped = episodes.groupby(keys, observed=True, sort=False)
    counts = grouped["outcome"].value_counts().unstack(fill_value=0).reindex(columns=list(OUTCOMES), fill_value=0)
    counts.insert(0, "n", grouped.size())
    counts["median s"] = grouped["settling_time_s"].median().round(3)
    counts["worst s"] = grouped["settling_time_s"].max().round(3)
    table = counts.reset_index()
    for key in keys:
        table[key] = table[key].astype(str)
    return table.sort_values(["start_set", "regulator"])
