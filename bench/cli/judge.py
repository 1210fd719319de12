"""`judge`: say what one law does, and why."""

import rich_click as click
from click.exceptions import Exit

from bench.base.on_first_use import pd
from bench.cli import options
from bench.cli.paragraphs import Paragraph, print_paragraphs
from bench.cli.screen import console, counted, examples, frame_table
from bench.findings.judgement import Judgement
from bench.findings.subjects import describe_readings, find_reading


@click.command("judge", epilog=examples("judge"))
@click.argument("law")
@options.valued(
    "--law-limit",
    5.0,
    "Time limit of 25 starts, or of a unit that cannot be cut [s].",
    type=options.LAW_LIMIT,
)
def COMMAND(law: str, law_limit: float) -> None:
    """Judge a law on the free body and explain the result. It takes seconds and writes no file.

    LAW is a file of yours, or the name of a law of the benchmark.

    It examines the command over all states (stiffness and damping at three goals, equilibria away from the goal,
    jumps), episodes from uniform, spinning and other starts (which are lost, and how they rest), and robustness. No
    episode is run where a fault of the command explains what episodes would show, as a wrong sign does. The laws of
    results/reference that are nearest to yours are listed: by the pull towards the goal at 90 degrees and the median
    settling time from uniform starts.
    """
    own = options.find_law(law)
    from bench.findings.judge_law import (
        judge_laws,
    )  # after the file is known to hold a law, for it takes a second

    with console(stderr=True).status("compiling and judging"):
        judgements = judge_laws((own,), law_limit)
    for one in judgements:
        print_judgement(one)
    if any(one.faults or one.is_lost for one in judgements):
        raise Exit(1)


def print_judgement(one: Judgement) -> None:
    """Print what a judgement says of a law, faults first, and the laws nearest to it."""
    screen = console()
    if one.heading not in ("", one.name):
        screen.print(one.heading)
    faults = f"{counted(len(one.faults), 'fault')}: {', '.join(one.faults)}." if one.faults else "no fault found."
    screen.print(f"{one.name}: {faults}\n")
    for head, is_fault in (("Faults", True), ("Otherwise" if one.faults else "Findings", False)):
        shown = [sentence for sentence in one.sentences if bool(sentence.fault) == is_fault]
        texts = tuple(f"{sentence.text} [{find_reading(sentence.subject)}]" for sentence in shown)
        print_paragraphs(Paragraph(head, texts))
    if one.beside:
        title = "\nThe laws of results/reference nearest to it in pull at 90 degrees and median settling time"
        screen.print(frame_table(pd.DataFrame(one.beside), f"{title} (a/b: a of b settled)"))
    screen.print(f"\n[..] are {describe_readings()}.")
