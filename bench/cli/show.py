"""`show`: a run's outcomes on one screen, or every count of them."""

import math
from pathlib import Path

import pandas as pd
import rich_click as click
from scipy.stats import binomtest

from bench.cli import options
from bench.cli.screen import console, frame_table
from bench.errors import BadResults
from bench.experiments.experiment import known_experiments
from bench.experiments.suites import NOMINAL
from bench.tables import read as results
from bench.tables.store import read, read_json
from tasks.cause import CAUSES
from tasks.verdict import CRASHED, OUTCOMES


@click.command("show")
@click.argument("folder", required=False, type=click.Path(path_type=Path))
@click.option("--engine", metavar="NAME", help="Only this engine.")
@click.option("--starts", metavar="NAME", help="Only this start set, with the count of each outcome.")
@click.option("--outcomes", is_flag=True, help="The count of each outcome for every start set.")
@options.regulator
def COMMAND(folder, engine, starts, outcomes, regulators):
    """Summary of a run: where each law settles, how fast, and where it does not (default: results/latest).

    Of an arm, each controller apart, with what its failures were near; then plants that are not the model's, what came
    of tasks in contact, and last of laws in trouble. A law, start set or engine that is named leaves out what it does
    not take part in.
    """
    folder = folder or results.folder()
    episodes = read(folder, "episodes")
    for column, word in (("engine", engine), ("start_set", starts)):
        episodes = _only(episodes, folder, column, (word,) if word else ())
    episodes = _of_laws(episodes, folder, regulators)
    origin = _origin(folder / "provenance.json")
    console().print(
        f"{folder}: suite {origin['suite']}, {origin['episodes']:,} episodes, commit {origin['commit'][:10] or 'none'}"
        f"{' with changes' if origin['dirty'] else ''}, {origin['cpu']}, {origin['wall_s']} s"
    )
    if outcomes or starts:
        for place, part in _places(episodes):
            console().print(frame_table(outcome_table(part), f"\n{place}"))
        return
    for place, part in _places(episodes[episodes["arm"] == ""]):
        console().print(frame_table(summary(part), f"\n{place}: settled of SO(3), and not settled by start set"))
    on_arms = episodes[episodes["arm"] != ""]
    for place, part in _places(on_arms[on_arms["variation"] == NOMINAL]):
        console().print(frame_table(arm_summary(part), f"\n{place}: settled by start set, and what failures were near"))
    for place, part in _places(on_arms[on_arms["variation"] != NOMINAL]):
        title = f"\n{place}, plant other than the model: settled of {_most(part)}, and median angle left [mrad]"
        console().print(frame_table(variation_summary(part), title))
    if not (engine or regulators):
        for arm, part in read(folder, "compliance").groupby("arm", observed=True, sort=False):
            title = f"\nin contact, {arm}: poses done, and median and worst of them"
            console().print(frame_table(contact_summary(part), title))
        troubled = read(folder, "robustness")
        if len(troubled):
            title = f"\nin trouble: axes where {MASTERED} % settle at every level; of others the smallest share [%]"
            console().print(frame_table(robustness_summary(troubled), title))
        for one in known_experiments().values():
            if one.summary:
                console().print(frame_table(one.summary(read(folder, one.table)), f"\n{one.title}"))
    console().print("\nThe counts of each outcome: --outcomes")


def _places(episodes):
    """(engine, and arm if there is one), its rows."""
    for (engine, arm), part in episodes.groupby(["engine", "arm"], observed=True, sort=False):
        yield (f"{engine}, {arm}" if arm else engine), part


def _only(episodes, folder, column, words):
    known = sorted(episodes[column].unique())
    for word in words:
        if word not in known:
            kind = column.replace("_", " ")
            raise click.UsageError(f"{folder} has no {kind} '{word}'; it has: {', '.join(known)}")
    return episodes[episodes[column].isin(words)] if words else episodes


def _of_laws(episodes, folder, words):
    """The rows of the laws: by regulator, with its representation, or with its Jacobian and inverse too."""
    if not words:
        return episodes
    named = results.with_contender(episodes)
    law = named["contender"].astype(str)
    names = pd.DataFrame({"regulator": named["regulator"].astype(str), "law": law.str.partition("@")[0], "whole": law})
    for word in words:
        if not (names == word).to_numpy().any():
            known = ", ".join(sorted(names["law"].unique()))
            raise click.UsageError(f"{folder} has no regulator '{word}'; it has: {known}")
    return episodes[names.isin(words).any(axis=1).to_numpy()]


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


def arm_summary(episodes):
    """One line for each controller: settled of each start set, settling times [s], and the causes of its failures."""
    lines = []
    for name, rows in results.with_contender(episodes).groupby("contender", observed=True, sort=False):
        line = {"controller": str(name)}
        for start_set, part in rows.groupby("start_set", observed=True, sort=True):
            line[str(start_set)] = f"{(part['outcome'] == 'settled').sum()}/{len(part)}"
        settled = rows["settling_time_s"].dropna()
        line["median s"] = f"{settled.median():.3f}" if len(settled) else "never"
        line["worst s"] = f"{settled.max():.3f}" if len(settled) else "never"
        causes = rows["cause"].astype(str).value_counts()
        line["failures near"] = ", ".join(f"{causes[one]} {one}" for one in CAUSES if one and one in causes)
        lines.append(line)
    return pd.DataFrame(lines)


def variation_summary(episodes):
    """One line for each controller, one column for each variation of the plant: settled, and the median angle left."""
    lines = []
    for name, rows in results.with_contender(episodes).groupby("contender", observed=True, sort=False):
        line = {"controller": str(name)}
        for variation, part in rows.groupby("variation", observed=True, sort=False):
            left = 1e3 * part["final_angle_rad"].median()
            line[str(variation)] = f"{(part['outcome'] == 'settled').sum()}  {left:.3g}"
        lines.append(line)
    return pd.DataFrame(lines)


IN_CONTACT = {
    "leakage_ratio": ("leakage", 1.0),
    "misalignment_rad": ("misaligned deg", 180.0 / math.pi),
    "alignment_error_rad": ("off the plate deg", 180.0 / math.pi),
}
"""Columns of compliance.parquet that are summarized: as what, in which unit."""


def contact_summary(rows):
    """One line for each controller: poses whose trials are all done, then median and worst of IN_CONTACT over them."""
    lines = []
    for name, part in results.with_compliant(rows).groupby("contender", observed=True, sort=False):
        done = part[part["outcome"] == "done"]
        line = {"controller": str(name), "done": f"{len(done)}/{len(part)}"}
        for column, (title, scale) in IN_CONTACT.items():
            some = scale * done[column].dropna()
            line[title] = f"{some.median():.3f}  {some.max():.3f}" if len(some) else ""
        lines.append(line)
    return pd.DataFrame(lines)


MASTERED = 95
"""Share of its starts [%] that a law settles at every level of an axis that it masters."""


def robustness_summary(rows):
    """One line for each law: how many axes it masters, and its smallest share [%] on others that some law masters."""
    named = results.with_contender(rows)
    settled = 100.0 * (named["outcome"] == "settled")
    shares = settled.groupby([named["contender"], named["axis"], named["level"]], observed=True, sort=False).mean()
    least = shares.groupby(level=[0, 1], observed=True, sort=False).min().unstack()
    lines = []
    for name, one in least.loc[:, (least >= MASTERED).any()].iterrows():
        short = ", ".join(f"{axis} {share:.0f}" for axis, share in one.items() if share < MASTERED)
        lines.append({"law": str(name), "masters": f"{(one >= MASTERED).sum()}/{one.size}", "settled least": short})
    return pd.DataFrame(lines)


def _most(episodes) -> int:
    """Episodes of one controller in one variation."""
    names = ["regulator", "representation", "jacobian", "inverse", "variation"]
    return int(episodes.groupby(names, observed=True).size().max())


def outcome_table(episodes):
    """One line for each start set and law: counts of outcomes, then median and worst settling time [s]."""
    varies = "variation" in episodes and (episodes["variation"] != NOMINAL).any()
    keys = ["start_set", "variation", "law"] if varies else ["start_set", "law"]
    named = results.with_contender(episodes).rename(columns={"contender": "law"})
    grouped = named.groupby(keys, observed=True, sort=False)
    usual = [word for code, word in enumerate(OUTCOMES) if code < CRASHED or (episodes["outcome"] == word).any()]
    counts = grouped["outcome"].value_counts().unstack(fill_value=0).reindex(columns=usual, fill_value=0)
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
