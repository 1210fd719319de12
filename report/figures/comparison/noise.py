"""Noise at 180° for the laws that the picture of the chapter leaves out, on the page that compares all laws."""

from bench.findings.theory.thresholds import HALF_TURN
from report.figures.kit.page import Run
from report.figures.robustness.half_turn_noise import SHOWN, WITH, WITHOUT, leaving, split_by_memory, starts, strips
from report.figures.robustness.robustness import along, laws


def facts(run: Run) -> dict:
    """Return the picture, what it shows, and how many starts it has."""
    rows = along(run, HALF_TURN)
    others = [law for law in laws(rows, controls=False) if law not in SHOWN]
    noisy, groups = leaving(rows), split_by_memory(others)
    first = float(noisy.index.min())
    trapped = [law for law in groups.get(WITHOUT, []) if noisy.loc[first, law] == 0.0]
    leave = [law for law in groups.get(WITH, []) if noisy.loc[first, law] == 1.0]
    return {
        "finding": (
            f"Noise of {first:g} rad traps the body at 180° with {len(trapped)} of the {len(groups.get(WITHOUT, []))} "
            f"other laws without memory, and every start leaves 180° with {len(leave)} of the "
            f"{len(groups.get(WITH, []))} others with memory"
        ),
        "starts": starts(rows),
        "others": strips(rows, others),
    }
