"""The chapter on what an error must do: how many laws settle from everywhere, and how many noise cannot hold."""

from bench.experiments.situations import NOISE_RAD
from bench.findings.selection.needs import is_unheld, measured, settles_everywhere
from report.figures.kit import families
from report.figures.kit.page import Run

MUJOCOS = "in-engine"
"""MuJoCo's actuator, which is the rotation vector's law."""


def facts(run: Run) -> dict[str, object]:
    """Count laws by what they have: starts that all settle, no noise that holds them at 180°, no memory."""
    found = measured(run.folder)
    shown = [law for law in found.laws if law not in (*families.CONTROLS, MUJOCOS)]
    whole = [law for law in shown if settles_everywhere(found, law)]
    forgetful = [law for law in shown if not found.number("memory", law) and law in found.values["held"]]
    return {
        "laws": len(shown),
        "whole": len(whole),
        "unheld": sum(is_unheld(found, law) for law in whole),
        "noise": f"{NOISE_RAD:g}",
        "forgetful": len(forgetful),
        "forgetful_both": sum(settles_everywhere(found, law) and is_unheld(found, law) for law in forgetful) or "none",
    }
