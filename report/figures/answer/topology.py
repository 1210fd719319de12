"""The chapter on what an error must do: one start and three fates, and how many laws settle from everywhere."""

import math

import numpy as np

from bench.experiments.situations import NOISE_RAD
from bench.experiments.tables.run import Run
from bench.findings.amounts import join_words
from bench.findings.selection.regions import list_facts
from bench.findings.selection.run_rows import compare_run, is_unheld, settles_everywhere
from report.figures.kit import families, html, media
from report.figures.kit.page import in_run

MUJOCOS = "in-engine"
"""MuJoCo's actuator, which is the rotation vector's law."""

STUCK = "stuck"
"""The outcome that a film describes by a participle; the others by a verb."""

FILM_HEIGHT = 313
"""Height of the film [px] at the width that `media.loop` gives it."""


def facts(run: Run) -> dict[str, object]:
    """Return the film of three fates, and the counts of laws."""
    return {
        "fates": show_fates(),
        "fates_finding": describe_fates(),
        "fates_slower": media.facts()["fates"]["slower"],
        **(in_run(count_laws, run) or {}),
    }


def show_fates() -> html.Html:
    """Return the film of a gripper under three laws."""
    return media.loop(f"A gripper under three laws. {describe_fates()}.", "fates-loop", height=FILM_HEIGHT)


def describe_fates() -> str:
    """Say what each law of the film does from each of its starts."""
    by_start: dict[int, list[str]] = {}
    for episode in media.facts()["fates"]["episodes"]:
        angle = round(math.degrees(episode["angle0_rad"]))
        verb = "is " if episode["outcome"] == STUCK else ""
        by_start.setdefault(angle, []).append(f"{verb}{episode['says']} with {families.word(episode['contender'])}")
    return ". ".join(
        f"From a start {angle}° away from the goal, the body {join_words(says)}" for angle, says in by_start.items()
    )


def count_laws(run: Run) -> dict[str, object]:
    """Count laws by what they have: starts that all settle, no noise that holds them at 180°, no memory."""
    every = compare_run(run.folder).rows
    rows = every[~every["contender"].isin((*families.CONTROLS, MUJOCOS))]
    is_whole = settles_everywhere(rows)
    has_both = is_whole & is_unheld(rows)
    has_memory = np.array([fact.memory > 0 for fact in list_facts(rows)], dtype=bool)
    is_forgetful = ~has_memory & rows["held"].notna()
    unheld = int(has_both.sum())
    return {
        "laws": len(rows),
        "whole": int(is_whole.sum()),
        "unheld": unheld,
        "unheld_memory": describe_part(int((has_both & has_memory).sum()), unheld),
        "noise": f"{NOISE_RAD:g}",
        "forgetful": int(is_forgetful.sum()),
        "forgetful_both": int((has_both & is_forgetful).sum()) or "none",
    }


def describe_part(part: int, of: int) -> str:
    """Say how many of some laws have something, with the verb."""
    if part == of:
        return f"all {of} of these laws have"
    return f"{part or 'none'} of these {of} laws {'has' if part <= 1 else 'have'}"
