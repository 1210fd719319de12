"""`judge`: one law, alone: what it does, and why."""

from __future__ import annotations

import dataclasses
from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click
from click.exceptions import Exit

from bench.cli import options
from bench.cli.paragraphs import Paragraph, print_paragraphs
from bench.cli.screen import console, counted, examples, frame_table

if TYPE_CHECKING:
    import pandas as pd

EPILOG = examples(
    ("A law of your own (README has an example)", "judge my_law.py"),
    after="A fault is a start that is lost, a dead point, chatter, or a stiffness or damping other than the gains say. "
    'A law whose property is "almost global" may have dead points at rotations of 180 degrees and lose starts there.\n'
    "Exit code 1: a fault. 2: no verdict, as of a file that holds no law. Against an older version of the same law: "
    "make judge LAW=my_law.py BASE=main.",
)

ENGINE = "ideal-rk4"
START_SETS = ("uniform", "half-turn", "tumbling", "goals")
LIMIT_S, TRIED = 5.0, 3
"""Seconds of processor time for a unit, ten times what a law of ours takes; and episodes of a lost one that are tried
singly before the rest counts as lost too."""


@click.command("judge", epilog=EPILOG)
@click.argument("law", type=options.PATH)
@click.option(
    "--law-limit", type=click.FloatRange(0.1), default=LIMIT_S, show_default=True, help="Seconds until a unit is hung."
)
def COMMAND(law: Path, law_limit: float):
    """Judge a law of yours on the free body and say why it does what it does: seconds, nothing is written.

    Asked for: its command over all states (stiffness and damping at three goals, dead points, jumps), episodes from
    uniform, half-turn, spinning and other starts (what is lost, and how it rests), and robustness. Beside it stand the
    laws of results/reference that are most like it.
    """
    from bench.contenders.registry import contenders_of
    from bench.running.sandbox import LOST, Sandbox

    laws = contenders_of(*options.own_laws((law,)))
    plan, parts = plan_of(laws), defaultdict(list)
    with console(stderr=True).status("compiling and judging"), Sandbox(plan, law_limit, TRIED) as sandbox:
        sandbox.check()
        given_up = set()  # of a law that hangs the rest would take minutes more
        for unit in plan.units:
            if unit.contender in given_up or (unit.experiment == "robustness" and sandbox.notes):
                continue
            made = sandbox.rows(unit).to_pandas()
            parts[unit.contender, unit.experiment].append(made)
            if sandbox.notes and unit.experiment == "free-body" and made["outcome"].isin(LOST).all():
                given_up.add(unit.contender)
        is_lost = bool(sandbox.notes)
    faults = [fault for one in laws for fault in _told(one, parts)]
    if faults or is_lost:
        raise Exit(1)


def plan_of(laws):
    """The command field, the episodes and the perturbations of some laws."""
    from bench.experiments import plan as planning
    from bench.experiments.choice import Choice

    episodes = Choice(("free-body",), START_SETS, (ENGINE,), experiments=("free-body", "command-field"))
    first = planning.make("quick", laws, episodes)
    second = planning.make("quick", laws, Choice(experiments=("robustness",)))
    return dataclasses.replace(first, units=first.units + second.units)


def said_of(one, parts) -> tuple[list, pd.DataFrame, pd.DataFrame]:
    """All that there is to say of a law; its command field and its episodes. parts: rows by law and experiment."""
    import pandas as pd

    from bench.findings import why
    from bench.tables.read import with_contender

    field, episodes, perturbed = (
        pd.concat([pd.DataFrame(), *parts[one.name, name]], ignore_index=True)
        for name in ("command-field", "free-body", "robustness")
    )
    declared = one.regulator.property
    said = [*why.sentences(field, declared), *why.ends(episodes, declared), *why.perturbed(perturbed)]
    return said, field, with_contender(episodes)


def _told(one, parts) -> list[str]:
    """Print what there is to say of a law; the faults."""
    from bench.findings.why import beside
    from bench.tables.read import table

    said, field, episodes = said_of(one, parts)
    faults = list(dict.fromkeys(each.fault for each in said if each.fault))
    verdict = f"{counted(len(faults), 'fault')}: {', '.join(faults)}." if faults else "no fault found."
    console().print(f"{one.name}: {verdict}\n")
    for head, is_fault in (("Faults", True), ("Otherwise", False)):
        texts = tuple(f"{each.text} [{each.page}]" for each in said if bool(each.fault) == is_fault)
        print_paragraphs(Paragraph(head, texts))
    run = table(options.REFERENCE, "episodes")
    run = run[(run["arm"] == "") & (run["engine"] == ENGINE) & run["start_set"].isin(START_SETS)]
    if len(field):
        shown = beside(field, episodes, table(options.REFERENCE, "command-field"), run)
        console().print(frame_table(shown, "\nBeside the laws most like it (results/reference; a/b: a of b settled)"))
    console().print("\n[..] are pages of the book: report/pages, or make report.")
    return faults
