"""`judge`: one law, alone: what it does, and why."""

import dataclasses
from pathlib import Path

import pandas as pd
import rich_click as click
from click.exceptions import Exit

from bench.cli import options
from bench.cli.paragraphs import Paragraph, print_paragraphs
from bench.cli.screen import console, counted, frame_table

EPILOG = """
[b]python -m bench judge my_law.py[/b]

Exit code 1: a fault. 2: a mistake in what was asked, as a file that holds no law.

A fault is a start that is lost, a dead point, chatter or oscillation at the goal, or a stiffness or damping that is not
what the gains say. A law whose property is "almost global" may be dead at half turns and lose starts there.

Against an older version of the same law: [b]make judge LAW=my_law.py BASE=main[/b].
"""

ENGINE = "ideal-rk4"
START_SETS = ("uniform", "half-turn", "tumbling", "goals")
LIMIT_S, TRIED = 5.0, 3
"""Seconds of processor time for a unit, ten times what a law of ours takes; and episodes of a lost one that are tried
singly before the rest counts as lost too."""


@click.command("judge", epilog=EPILOG)
@click.argument("law", type=options.PATH)
@click.option(
    "--law-limit",
    type=click.FloatRange(min=0.0, min_open=True),
    default=LIMIT_S,
    show_default=True,
    metavar="SECONDS",
    help="A unit of work that takes longer is stopped there, and hung.",
)
def COMMAND(law: Path, law_limit: float):
    """Judge a law of yours on the free body and say why it does what it does: seconds, nothing is written.

    Asked for: its command over all states (stiffness and damping at three goals, dead points, jumps, chatter), episodes
    from uniform, half-turn, spinning and other starts, and robustness. Beside it stand the laws of results/reference
    that are most like it.
    """
    from bench.contenders.registry import contenders_of
    from bench.running.sandbox import Sandbox
    from bench.tables.read import with_contender

    [own] = options.own_laws((law,))
    plan = plan_of(contenders_of(own))
    frames: dict[str, list] = {}
    with console(stderr=True).status("compiling and judging"), Sandbox(plan, law_limit, TRIED) as sandbox:
        sandbox.check()
        for unit in plan.units:
            if unit.experiment != "robustness" or not sandbox.notes:  # a law that hangs would take minutes more
                frames.setdefault(unit.experiment, []).append(sandbox.rows(unit).to_pandas())
        is_lost = bool(sandbox.notes)
    tables = {name: with_contender(pd.concat(some, ignore_index=True)) for name, some in frames.items()}
    faults = [fault for one in contenders_of(own) for fault in told(one, tables, plan.settings.gains.kp)]
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


def told(one, tables: dict[str, pd.DataFrame], kp: float) -> list[str]:
    """Print what there is to say of a law; the faults."""
    from bench.findings.why import nearest, outcomes, sentences
    from bench.tables.read import table

    field, episodes, perturbed = (
        frame[frame["contender"] == one.name] if len(frame := tables.get(name, pd.DataFrame())) else frame
        for name in ("command-field", "free-body", "robustness")
    )
    declared = one.regulator.property
    said = sentences.sentences(field, kp, declared) + outcomes.settled(episodes, declared)
    said += outcomes.perturbed(perturbed)
    if field.empty:
        said.append(sentences.Said("Its command was not looked at: it crashed or hung.", sentences.FAILURES, "broken"))
    faults = list(dict.fromkeys(one.fault for one in said if one.fault))
    lines = {"Faults": [one for one in said if one.fault], "Otherwise": [one for one in said if not one.fault]}
    verdict = f"{counted(len(faults), 'fault')}: {', '.join(faults)}." if faults else "no fault found."
    console().print(f"{one.name}: {verdict}\n")
    print_paragraphs(*(Paragraph(head, tuple(f"{s.text} [{s.page}]" for s in some)) for head, some in lines.items()))
    run = table(options.REFERENCE, "episodes")
    run = run[(run["arm"] == "") & (run["engine"] == ENGINE) & run["start_set"].isin(START_SETS)]
    if len(field):
        shown = nearest.beside(field, episodes, table(options.REFERENCE, "command-field"), run)
        console().print(frame_table(shown, "\nBeside the laws most like it (results/reference; a/b: a of b settled)"))
    console().print("\n[..] are pages of the book: report/pages, or make report.")
    return faults
