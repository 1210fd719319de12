"""Noise at 180° for the laws that the picture of the chapter leaves out, on the page that compares all laws."""

from bench.experiments.tables.run import Run
from bench.findings.theory.thresholds import HALF_TURN
from report.figures.robustness.half_turn_noise import (
    SHOWN,
    WITH,
    WITHOUT,
    count,
    leaving,
    split_by_memory,
    starts,
    strips,
)
from report.figures.robustness.robustness import along, laws


def facts(run: Run) -> dict:
    """Return the picture, what it shows, and how many starts it has."""
    rows = along(run, HALF_TURN)
    others = [law for law in laws(rows, controls=False) if law not in SHOWN]
    noisy, groups = leaving(rows), split_by_memory(others)
    first = float(noisy.index.min())
    trapped = [law for law in groups.get(WITHOUT, []) if noisy.loc[first, law] == 0.0]
    leave = [law for law in groups.get(WITH, []) if noisy.loc[first, law] == 1.0]
    without_memory = count(len(trapped), len(groups.get(WITHOUT, [])))
    with_memory = count(len(leave), len(groups.get(WITH, [])))
    return {
        "finding": (
            f"Measurement noise of {first:g} rad traps the body at 180° with {without_memory} laws without "
            f"memory in this picture. With {with_memory} laws with memory in this picture, "
            "the body leaves 180° from every start"
        ),
        "starts": starts(rows),
        "most": f"{float(noisy.index.max()):g}",
        "others": strips(rows, others),
    }
