"""`show`: a run on one screen, or its tables in full."""

from pathlib import Path

import rich_click as click

from bench.base.errors import BadResults
from bench.cli import options
from bench.cli.paragraphs import origin
from bench.cli.screen import console, examples, frame_table, shown_path


@click.command("show", epilog=examples("show"))
@click.argument("folder", required=False)
@click.argument("part", required=False)
@click.option("--details", is_flag=True, help="The advice in full, what failed, and every table.")
@click.option("--outcomes", is_flag=True, help="The count of each outcome for every start set.")
@options.regulator
def COMMAND(folder: str | None, part: str | None, details: bool, outcomes: bool, regulators: options.Words) -> None:
    """Show a run in at most 40 lines, the table of its laws first (default: results/latest).

    The summary of a whole suite replicates the paper: its laws and later ones, its Jacobians, its claims, and what to
    use today. A run of some laws shows them beside each other; the claims are judged only if the run holds the paper's.

    FOLDER may be left out. PART is free-body, arms, contact or robustness: the tables of that part. In them a/b counts
    episodes: a of b settled (in contact: poses done). --regulator and --outcomes show tables of
    free body and arms.
    """
    path, part = _meant(folder, part)
    given = ["--outcomes"] * outcomes + ["--regulator"] * bool(regulators)
    if not (details or part or given):
        from bench.cli.summary.whole import (
            print_summary,  # what judges claims takes seconds to import
        )

        print_summary(path, is_named=folder is not None)
        return
    if part not in (None, "free-body", "arms") and given:
        raise click.UsageError(f"{part} takes no {given[0]}, which is about episodes from start sets; leave it away")
    if details and not (part or given):
        from bench.cli.summary.details import print_sentences

        print_sentences(path)
        console().print()
    found = _tables(path, part, outcomes, regulators)
    console().print(origin(path))
    for title, frame in found:
        console().print(frame_table(frame, f"\n{title}"))
    if not found:
        console().print(f"\nThere is nothing of {part or 'any part'} in this run.")


def _meant(folder: str | None, part: str | None) -> tuple[Path, str | None]:
    """Return the folder and the part that one or two words mean; UsageError or BadResults if they mean none."""
    from bench.cli.details import PARTS
    from bench.experiments.tables.run import shown_folder

    if part is None and folder in PARTS:
        return shown_folder(), folder
    if part is not None and part not in PARTS:
        raise click.UsageError(f"'{part}' is no part of a run; parts: {', '.join(PARTS)} (try: show {folder} arms)")
    path = Path(folder) if folder else shown_folder()
    if folder and not path.exists():
        raise BadResults(
            f"{folder}: there is no such folder, nor such a part; parts: {', '.join(PARTS)}; `make bench` makes "
            "results/latest (try: bench show)"
        )
    return path, part


def _tables(folder: Path, part: str | None, outcomes: bool, regulators: options.Words) -> list:
    """Titles and tables of a part, or of all."""
    from bench.cli.details import contact, robustness
    from bench.cli.details.episodes import (
        of_laws,
        outcome_table,
        places,
        tables_of_arms,
        tables_of_free_body,
    )
    from bench.experiments.tables.run import Run

    run = Run(folder)
    episodes = run.table("episodes")
    if part in ("free-body", "arms"):
        episodes = episodes[(episodes["arm"] != "") == (part == "arms")]
    episodes = of_laws(episodes, shown_path(folder), regulators)
    if outcomes:
        return [(place, outcome_table(rows)) for place, rows in places(episodes)]
    tables_of = {
        "free-body": lambda: tables_of_free_body(episodes[episodes["arm"] == ""]),
        "arms": lambda: tables_of_arms(episodes[episodes["arm"] != ""]),
        "contact": lambda: contact.tables(run.table("compliance")),
        "robustness": lambda: robustness.tables(run.table("robustness")),
    }
    wanted = [part] if part else [*tables_of][:2] if regulators else tables_of
    return [table for one in wanted for table in tables_of[one]()]
