"""`show`: a run's outcomes on one screen, or every count of them."""

from pathlib import Path

import pandas as pd
import rich_click as click
from scipy.stats import binomtest

from bench import results
from bench.cli import options
from bench.cli.screen import console, frame_table
from bench.errors import BadResults
from bench.store import read, read_json
from tasks.verdict import OUTCOMES


@click.command("show")
@click.argument("folder", required=False, type=click.Path(path_type=Path))
@click.option("--engine", metavar="NAME", help="Only this engine.")
@click.option("--starts", metavar="NAME", help="Only this start set, with the count of each outcome.")
@click.option("--outcomes", is_flag=True, help="The count of each outcome for every start set.")
@options.regulator
def COMMAND(folder, engine, starts, outcomes, regulators):
    """Summary of a run: where each law settles, how fast, and where it does not (default: results/latest)."""
    folder = folder or results.folder()
    episodes = read(folder, "episodes")
    for column, words in (("engine", engine), ("start_set", starts), ("regulator", regulators)):
        episodes = _only(episodes, folder, column, (words,) if isinstance(words, str) else words or ())
    origin = _origin(folder / "provenance.json")
    console().print(
        f"{folder}: suite {origin['suite']}, {origin['episodes']:,} episodes, commit {origin['commit'][:10] or 'none'}"
        f"{' with changes' if origin['dirty'] else ''}, {origin['cpu']}, {origin['wall_s']} s"
    )
    table = outcome_table if outcomes or starts else summary
    for (engine_name, arm), part in episodes.groupby(["engine", "arm"], observed=True, sort=False):
        console().print(frame_table(table(part), f"\n{engine_name}{f', {arm}' if arm else ''}"))
    if not (outcomes or starts):
        console().print("\nNot settled, by start set; the counts of each outcome: --outcomes", markup=False)


def _only(episodes, folder, column, words):
    known = sorted(episodes[column].unique())
    for word in words:
        if word not in known:
            kind = column.replace("_", " ")
            raise click.UsageError(f"{folder} has no {kind} '{word}'; it has: {', '.join(known)}")
    return episodes[episodes[column].isin(words)] if words else episodes


def summary(episodes):
    """One line for each law: share of SO(3) settled, settling times [s], failures of each directed start set."""
    lines = []
    for law_name, law in results.with_contender(episodes).groupby("contender", observed=True, sort=False):
        line = {"law": str(law_name)}
        for name, part in law.groupby("start_set", observed=True, sort=True):
            settled = int((part["outcome"] == "settled").sum())
            if name == "uniform":
                low, high = binomtest(settled, len(part)).proportion_ci(method="wilson")
                line["settled of SO(3)"] = f"{settled / len(part):.2%} [{low:.2%}, {high:.2%}]"
                line["median s"] = f"{part['settling_time_s'].median():.3f}" if settled else "never"
                line["worst s"] = f"{part['settling_time_s'].max():.3f}" if settled else "never"
            else:
                line[str(name)] = f"{len(part) - settled}/{len(part)}"
        lines.append(line)
    table = pd.DataFrame(lines)
    first = [name for name in ("law", "settled of SO(3)", "median s", "worst s") if name in table]
    return table[first + [name for name in table if name not in first]]


def outcome_table(episodes):
    """One line for each start set and law: counts of outcomes, then median and worst settling time [s]."""
    keys = ["start_set", "law"]
    named = results.with_contender(episodes).rename(columns={"contender": "law"})
    grouped = named.groupby(keys, observed=True, sort=False)
    counts = grouped["outcome"].value_counts().unstack(fill_value=0).reindex(columns=list(OUTCOMES), fill_value=0)
    counts.insert(0, "n", grouped.size())
    counts["median s"] = grouped["settling_time_s"].median().round(3)
    counts["worst s"] = grouped["settling_time_s"].max().round(3)
    table = counts.reset_index()
    for key in keys:
        table[key] = table[key].astype(str)
    return table.sort_values(keys)


def _origin(path: Path) -> dict:
    """What the first line of the summary names."""
    origin = read_json(path)
    lacking = [name for name in ("suite", "episodes", "commit", "dirty", "cpu", "wall_s") if name not in origin]
    if lacking:
        raise BadResults(f"{path}: it lacks {', '.join(lacking)}; delete the folder and run again")
    return origin
